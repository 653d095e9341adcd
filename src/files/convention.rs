//! Conventions by name, or by a TOML file.

use std::path::Path;

use svbrdf_core::error::Error as CoreError;
use svbrdf_core::model::convention::Convention;
use svbrdf_core::model::grammar::Description;
use svbrdf_core::model::named_conventions as named;

use crate::disk::inputs;
use crate::disk::open::NamedFile;
use crate::error::Error;

/// The convention of this name, or in this file, whose name ends with `.toml`.
///
/// # Errors
/// [`CoreError::UnknownName`]; [`Error::BadConvention`]; where the file cannot be read.
pub fn read(text: &str) -> Result<Description, Error> {
    let path = Path::new(text);
    if path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("toml")) {
        let read = NamedFile::by_user(path).text()?;
        inputs::protect(path);
        let convention: Result<Description, CoreError> = read.parse();
        let mut convention = convention.map_err(|problem| Error::BadConvention {
            path: path.to_owned(),
            problem: problem.to_string(),
        })?;
        if convention.name.is_empty() {
            convention.name = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        }
        return Ok(convention);
    }
    let known = || named::all().iter().map(|known| known.name.as_str()).collect::<Vec<_>>().join(", ");
    let found = named::all().iter().find(|known| known.name == text);
    Ok(found
        .cloned()
        .ok_or_else(|| CoreError::unknown_name("convention", text, known() + ", or a .toml file"))?)
}

/// [`read`], as a convention that losses are computed by.
///
/// # Errors
/// As [`read`]; [`CoreError::BadConvention`] for scenes that cannot be sampled.
pub fn of_loss(text: &str) -> Result<Convention, Error> {
    Ok(Convention::try_from(&read(text)?)?)
}
