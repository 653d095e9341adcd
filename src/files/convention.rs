//! Conventions by name, by a TOML file, or by their text.

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

/// A convention that losses are computed by, and where it is from.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ChosenConvention {
    pub convention: Convention,
    /// The file that it was read from.
    pub file: Option<PathBuf>,
    /// Its text, where it is one of the user's own.
    text: Option<String>,
}

impl From<Convention> for ChosenConvention {
    fn from(named: Convention) -> Self {
        Self { convention: named, file: None, text: None }
    }
}

impl ChosenConvention {
    /// The convention of this name, in this file, or of this text.
    ///
    /// # Errors
    /// As [`of_loss`].
    pub fn read(text: &str) -> Result<Self, Error> {
        let (described, path) = (read(text)?, Path::new(text));
        let file = is_file(path).then(|| path.to_owned());
        let own = (file.is_some() || is_text(text)).then(|| described.to_string());
        Ok(Self { convention: Convention::try_from(&described)?, file, text: own })
    }

    /// Whether it is one of the user's own.
    pub fn is_own(&self) -> bool {
        self.text.is_some()
    }

    /// What a session has of it, which is all of it: its name, or its text.
    pub fn content(&self) -> String {
        self.text.clone().unwrap_or_else(|| self.convention.name.to_owned())
    }

    /// What a command line has of it: its name, the absolute path of its file, or a file of its name where it is from a session.
    pub fn argument(&self) -> String {
        match &self.file {
            Some(file) => std::path::absolute(file).unwrap_or_else(|_| file.clone()).display().to_string(),
            None if self.is_own() => format!("{}.toml", self.convention.name.trim_end_matches(".toml")),
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

/// Whether this is the text of a convention, and neither a name nor a path.
pub fn is_text(text: &str) -> bool {
    text.contains('\n')
}

/// The convention of this name, in this file, whose name ends with `.toml`, or of this text, which has several lines.
///
/// # Errors
/// [`CoreError::UnknownName`]; [`CoreError::BadConvention`]; [`Error::BadConvention`]; where the file cannot be read.
pub fn read(text: &str) -> Result<Description, Error> {
    let path = Path::new(text);
    if is_file(path) {
        let read = NamedFile::by_user(path).text()?;
        inputs::protect(path);
        return own(&read, path)
            .map_err(|problem| Error::BadConvention { path: path.to_owned(), problem: problem.to_string() });
    }
    if is_text(text) {
        return Ok(own(text, Path::new("own.toml"))?);
    }
    let known = || named::all().iter().map(|known| known.name.as_str()).collect::<Vec<_>>().join(", ");
    let found = named::all().iter().find(|known| known.name == text);
    Ok(found
        .cloned()
        .ok_or_else(|| CoreError::unknown_name("convention", text, known() + ", or a .toml file"))?)
}

/// The convention of this text, which is named by its `file` where its own name is that of another one, or none.
fn own(text: &str, file: &Path) -> Result<Description, CoreError> {
    let mut convention: Description = text.parse()?;
    if convention.name.is_empty() {
        convention.name = file.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    }
    // A changed copy of a named one is not the named one.
    let is_other = |known: &Description| {
        known.name == convention.name
            && (known.terms, known.loss, &known.scenes)
                != (convention.terms, convention.loss, &convention.scenes)
    };
    if named::all().iter().any(is_other) {
        convention.name = file.file_name().unwrap_or_default().to_string_lossy().into_owned();
    }
    Ok(convention)
}

/// [`read`], as a convention that losses are computed by.
///
/// # Errors
/// As [`read`]; [`CoreError::BadConvention`] for scenes that cannot be sampled.
pub fn of_loss(text: &str) -> Result<Convention, Error> {
    Ok(Convention::try_from(&read(text)?)?)
}
