//! The door for files: the one place that opens a file to read it.
//!
//! A path is opened together with [who named it](NamedBy): what a user names is opened as named, what a file names goes
//! the same way today, and rules for it (regular files only, within the folder, up to a size) belong into [`opened`].
//! `clippy.toml` refuses every other way to open a file.

use std::fs::File;
use std::io::{BufReader, Read as _};
use std::path::{Path, PathBuf};

use svbrdf_core::error::Error;

/// Who named a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum NamedBy {
    /// A person: on the command line, in a dialog, by drag and drop, or as an argument in Python.
    User,
    /// The file of this path, such as a scene file, a sidecar file or a session; or the folder that lists it.
    File(PathBuf),
}

/// A path to be read, and who named it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NamedFile {
    path: PathBuf,
    by: NamedBy,
}

impl NamedFile {
    /// A file that a person named.
    pub fn by_user(path: impl Into<PathBuf>) -> Self {
        Self { path: path.into(), by: NamedBy::User }
    }

    /// A file that the file or folder `by` named.
    pub fn by_file(path: impl Into<PathBuf>, by: &Path) -> Self {
        Self { path: path.into(), by: NamedBy::File(by.to_owned()) }
    }

    pub fn path(&self) -> &Path {
        &self.path
    }

    pub fn named_by(&self) -> &NamedBy {
        &self.by
    }

    /// Opens it.
    ///
    /// # Errors
    /// Those of the system, without the name of the file.
    pub fn open(&self) -> std::io::Result<File> {
        opened(self)
    }

    /// Opens it for reading from its beginning.
    ///
    /// # Errors
    /// [`Error::Unreadable`].
    pub fn reader(&self) -> Result<BufReader<File>, Error> {
        opened(self).map(BufReader::new).map_err(|source| Error::unreadable(&self.path, source))
    }

    /// Everything that it holds.
    ///
    /// # Errors
    /// [`Error::Unreadable`].
    pub fn bytes(&self) -> Result<Vec<u8>, Error> {
        let mut bytes = Vec::new();
        let read = opened(self).and_then(|mut file| file.read_to_end(&mut bytes));
        read.map(|_| bytes).map_err(|source| Error::unreadable(&self.path, source))
    }

    /// Everything that it holds, in UTF-8.
    ///
    /// # Errors
    /// [`Error::Unreadable`], also where it is not UTF-8.
    pub fn text(&self) -> Result<String, Error> {
        let mut text = String::new();
        let read = opened(self).and_then(|mut file| file.read_to_string(&mut text));
        read.map(|_| text).map_err(|source| Error::unreadable(&self.path, source))
    }
}

/// The open file.
#[expect(clippy::disallowed_methods, reason = "this is the one place that opens files")]
fn opened(file: &NamedFile) -> std::io::Result<File> {
    match &file.by {
        NamedBy::User | NamedBy::File(_) => File::open(&file.path),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_is_read_whole_whoever_named_it() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.txt");
        std::fs::write(&path, "text").unwrap();
        for file in [NamedFile::by_user(&path), NamedFile::by_file(&path, folder.path())] {
            assert_eq!(file.text().unwrap(), "text");
            assert_eq!(file.bytes().unwrap(), b"text");
            assert_eq!(std::io::read_to_string(file.reader().unwrap()).unwrap(), "text");
        }
    }

    #[test]
    fn a_file_that_cannot_be_read_is_named_in_the_error() {
        let folder = tempfile::tempdir().unwrap();
        let absent = NamedFile::by_user(folder.path().join("none.txt"));
        let latin = folder.path().join("latin.txt");
        std::fs::write(&latin, b"\xe4").unwrap();
        for error in [absent.text().unwrap_err(), absent.bytes().unwrap_err()] {
            assert!(error.to_string().contains("none.txt"), "{error}");
        }
        assert!(absent.reader().is_err());
        let error = NamedFile::by_user(&latin).text().unwrap_err();
        assert!(matches!(error, Error::Unreadable { path, .. } if path == latin));
    }
}
