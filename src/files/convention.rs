//! Conventions by name, or by a TOML file.

use std::fmt;
use std::path::{Path, PathBuf};

use serde::{Serialize, Serializer};

use svbrdf_core::error::Error as CoreError;
use svbrdf_core::model::convention::Convention;
use svbrdf_core::model::grammar::Description;
use svbrdf_core::model::named_conventions as named;

use crate::disk::inputs;
use crate::disk::open::NamedFile;
use crate::error::Error;

/// A convention that losses are computed by, and the file that it was read from.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ChosenConvention {
    pub convention: Convention,
    /// `None`: it has a name.
    pub file: Option<PathBuf>,
}

impl ChosenConvention {
    /// The convention of this name, or in this file.
    ///
    /// # Errors
    /// As [`of_loss`].
    pub fn read(text: &str) -> Result<Self, Error> {
        let path = Path::new(text);
        Ok(Self { convention: of_loss(text)?, file: is_file(path).then(|| path.to_owned()) })
    }

    /// What [`Self::read`] finds it by: its name, or the absolute path of its file.
    pub fn text(&self) -> String {
        match &self.file {
            Some(file) => std::path::absolute(file).unwrap_or_else(|_| file.clone()).display().to_string(),
            None => self.convention.name.to_owned(),
        }
    }
}

/// The name.
impl fmt::Display for ChosenConvention {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.convention.name)
    }
}

impl Serialize for ChosenConvention {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        to.serialize_str(self.convention.name)
    }
}

/// Whether a path is that of a convention, by its ending.
pub fn is_file(path: &Path) -> bool {
    path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("toml"))
}

/// The convention of this name, or in this file, whose name ends with `.toml`.
///
/// # Errors
/// [`CoreError::UnknownName`]; [`Error::BadConvention`]; where the file cannot be read.
pub fn read(text: &str) -> Result<Description, Error> {
    let path = Path::new(text);
    if is_file(path) {
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
        // A changed copy of a named one is not the named one.
        let is_other = |known: &Description| {
            known.name == convention.name
                && (known.terms, known.loss, &known.scenes)
                    != (convention.terms, convention.loss, &convention.scenes)
        };
        if named::all().iter().any(is_other) {
            convention.name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
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
