//! The door for files: the one place that opens a file to read it.
//!
//! A path is opened together with [who named it](NamedBy). What a user names is a regular file, or a pipe, which is read with
//! a limit. What a file names is a regular file, by a path relative to that file: absolute paths, other drives and network
//! shares are refused without a look at them, unless [`allow_outside`]. Devices, sockets and, in files, pipes are refused
//! before they are opened; links are judged at their end. `.cargo/clippy.toml` refuses every other way to open a file.

use std::fs::{File, Metadata, OpenOptions};
use std::io::{self, BufReader, Read as _, Seek as _};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};

use sha2::{Digest as _, Sha256};

use crate::disk::memory;
use crate::disk::paths;
use crate::error::Error;

/// Whether files may name others by absolute paths.
static OUTSIDE: AtomicBool = AtomicBool::new(false);

/// Lets files name others by absolute paths, on other drives and network shares, from now on and in all of this process.
pub fn allow_outside() {
    OUTSIDE.store(true, Ordering::Relaxed);
}

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
    /// Whether it was named by an absolute path where only a relative one is allowed.
    is_refused: bool,
}

impl NamedFile {
    /// A file that a person named.
    pub fn by_user(path: impl Into<PathBuf>) -> Self {
        Self { path: path.into(), by: NamedBy::User, is_refused: false }
    }

    /// A file that the folder `by` lists, or that belongs to the file `by` by its name.
    pub fn by_file(path: impl Into<PathBuf>, by: &Path) -> Self {
        Self { path: path.into(), by: NamedBy::File(by.to_owned()), is_refused: false }
    }

    /// The file that the text of the file `by` names, relative to its folder.
    pub fn within(name: impl AsRef<Path>, by: &Path) -> Self {
        let (name, folder) = (name.as_ref(), by.parent().unwrap_or(Path::new("")));
        let is_refused = paths::is_absolute(name) && !OUTSIDE.load(Ordering::Relaxed);
        Self { path: folder.join(name), by: NamedBy::File(by.to_owned()), is_refused }
    }

    pub fn path(&self) -> &Path {
        &self.path
    }

    /// An error where it was named by an absolute path. A name that is refused must not be looked up either: on a network
    /// share of Windows, that alone tells another machine who the user is.
    ///
    /// # Errors
    /// [`Error::Outside`].
    pub fn check(&self) -> Result<(), Error> {
        match &self.by {
            NamedBy::File(by) if self.is_refused => {
                Err(Error::Outside { path: self.path.clone(), by: by.clone() })
            }
            _ => Ok(()),
        }
    }

    /// Whether there is such a file, as far as it may be looked up.
    pub(crate) fn exists(&self) -> bool {
        !self.is_refused && self.path.exists()
    }

    /// The file that names it, where it lies outside of the folder of that file.
    pub fn outside(&self) -> Option<&Path> {
        match &self.by {
            NamedBy::File(by) if !by.is_dir() => {
                let folder = by.parent().unwrap_or(Path::new(""));
                paths::is_outside(&self.path, folder).then_some(by)
            }
            _ => None,
        }
    }

    /// Opens it.
    ///
    /// # Errors
    /// [`Error::Unreadable`]; [`Error::Outside`]; [`Error::NotAFile`] for a device, a folder or a socket.
    pub fn open(&self) -> Result<File, Error> {
        self.check()?;
        let unreadable = |source| Error::unreadable(&self.path, source);
        let refused = |found: &Metadata| Error::NotAFile { path: self.path.clone(), found: kind(found) };
        // Before it is opened: opening alone has effects on some devices, and waits at a pipe.
        let found = self.path.metadata().map_err(unreadable)?;
        if self.by == NamedBy::User && is_pipe(&found) {
            return spooled(&self.path);
        }
        if !found.is_file() {
            return Err(refused(&found));
        }
        let file = opened(&self.path).map_err(unreadable)?;
        let found = file.metadata().map_err(unreadable)?;
        if found.is_file() { Ok(file) } else { Err(refused(&found)) }
    }

    /// Opens it for reading from its beginning.
    ///
    /// # Errors
    /// As [`Self::open`].
    pub fn reader(&self) -> Result<BufReader<File>, Error> {
        self.open().map(BufReader::new)
    }

    /// Everything that it holds.
    ///
    /// # Errors
    /// As [`Self::open`]; [`Error::Memory`] where it is too large.
    pub fn bytes(&self) -> Result<Vec<u8>, Error> {
        let mut file = self.open()?;
        let unreadable = |source| Error::unreadable(&self.path, source);
        let size = file.metadata().map_err(unreadable)?.len();
        let what = || format!("reading {}", self.path.display());
        let _reserved = memory::reserve(size, what)?;
        let mut bytes = Vec::new();
        // A file that grows meanwhile is not followed for ever.
        let read = file.by_ref().take(size.saturating_mul(2).max(1 << 20)).read_to_end(&mut bytes);
        read.map(|_| bytes).map_err(unreadable)
    }

    /// The SHA-256 of everything that it holds, in hexadecimal.
    ///
    /// # Errors
    /// As [`Self::open`]; [`Error::NotAFile`] for a pipe, which could not be read again.
    pub(crate) fn digest(&self) -> Result<String, Error> {
        if is_pipe_at(&self.path) {
            return Err(Error::NotAFile { path: self.path.clone(), found: "a pipe" });
        }
        let (mut file, mut buffer, mut hash) = (self.open()?, vec![0; 1 << 16], Sha256::new());
        loop {
            match file.read(&mut buffer).map_err(|source| Error::unreadable(&self.path, source))? {
                0 => return Ok(hexadecimal(hash)),
                count => hash.update(&buffer[..count]),
            }
        }
    }

    /// Everything that it holds, in UTF-8, without a byte order mark.
    ///
    /// # Errors
    /// As [`Self::bytes`]; [`Error::Unreadable`] where it is not UTF-8.
    pub fn text(&self) -> Result<String, Error> {
        let not_utf8 = |e: std::string::FromUtf8Error| {
            let problem =
                format!("expected a text, found other bytes after {}", e.utf8_error().valid_up_to());
            Error::unreadable(&self.path, io::Error::new(io::ErrorKind::InvalidData, problem))
        };
        let mut text = String::from_utf8(self.bytes()?).map_err(not_utf8)?;
        if text.starts_with('\u{feff}') {
            text.drain(..'\u{feff}'.len_utf8());
        }
        Ok(text)
    }
}

/// A digest as text.
pub fn hexadecimal(hash: Sha256) -> String {
    hash.finalize().iter().map(|byte| format!("{byte:02x}")).collect()
}

/// The open file. It is not waited for: a pipe that has taken the place of a file opens at once, and is refused.
#[expect(clippy::disallowed_methods, reason = "this is the one place that opens files")]
fn opened(path: &Path) -> io::Result<File> {
    let mut options = OpenOptions::new();
    #[cfg(unix)]
    std::os::unix::fs::OpenOptionsExt::custom_flags(
        &mut options,
        rustix::fs::OFlags::NONBLOCK.bits().cast_signed(),
    );
    options.read(true).open(path)
}

/// The content of a pipe as a file without a name, which decoders can go back in.
#[expect(clippy::disallowed_methods, reason = "this is the one place that opens files")]
fn spooled(path: &Path) -> Result<File, Error> {
    let limit = memory::limit();
    let copied = || -> io::Result<(File, u64)> {
        let mut file = tempfile::tempfile()?;
        let bytes = io::copy(&mut File::open(path)?.take(limit + 1), &mut file)?;
        file.rewind()?;
        Ok((file, bytes))
    };
    match copied().map_err(|source| Error::unreadable(path, source))? {
        (_, bytes) if bytes > limit => {
            let what = format!("the pipe {}", path.display());
            Err(Error::Memory { what, bytes, limit })
        }
        (file, _) => Ok(file),
    }
}

/// Whether a user who names this path gives a pipe.
pub fn is_pipe_at(path: &Path) -> bool {
    path.metadata().is_ok_and(|found| is_pipe(&found))
}

#[cfg(unix)]
fn is_pipe(found: &Metadata) -> bool {
    std::os::unix::fs::FileTypeExt::is_fifo(&found.file_type())
}

#[cfg(not(unix))]
fn is_pipe(_: &Metadata) -> bool {
    false
}

/// The noun for a thing that is no regular file.
fn kind(found: &Metadata) -> &'static str {
    if found.is_dir() {
        return "a folder";
    }
    if is_pipe(found) {
        return "a pipe";
    }
    "a device or a socket"
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_is_read_whole_whoever_named_it() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.txt");
        std::fs::write(&path, "text").unwrap();
        let by = folder.path().join("b.gltf");
        let files = [
            NamedFile::by_user(&path),
            NamedFile::by_file(&path, folder.path()),
            NamedFile::within("a.txt", &by),
        ];
        for file in files {
            assert_eq!(file.text().unwrap(), "text");
            assert_eq!(file.bytes().unwrap(), b"text");
            assert_eq!(io::read_to_string(file.reader().unwrap()).unwrap(), "text");
        }
    }

    #[test]
    fn a_byte_order_mark_is_no_text() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.txt");
        std::fs::write(&path, "\u{feff}text").unwrap();
        assert_eq!(NamedFile::by_user(&path).text().unwrap(), "text");
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

    #[test]
    fn a_name_in_a_file_is_relative() {
        let folder = tempfile::tempdir().unwrap();
        let by = folder.path().join("in/b.gltf");
        std::fs::create_dir(folder.path().join("in")).unwrap();
        std::fs::write(&by, "").unwrap();
        std::fs::write(folder.path().join("a.txt"), "text").unwrap();
        let above = NamedFile::within("../a.txt", &by);
        assert_eq!((above.text().unwrap().as_str(), above.outside()), ("text", Some(by.as_path())));
        assert_eq!(NamedFile::within("b.gltf", &by).outside(), None);
        let absolute = NamedFile::within(folder.path().join("a.txt"), &by);
        assert!(!absolute.exists());
        let error = absolute.text().unwrap_err();
        assert!(matches!(&error, Error::Outside { by: found, .. } if *found == by), "{error}");
    }

    #[cfg(unix)]
    #[test]
    fn only_regular_files_are_opened_and_nothing_is_waited_for() {
        let folder = tempfile::tempdir().unwrap();
        let of = |name: &str| folder.path().join(name);
        assert!(std::process::Command::new("mkfifo").arg(of("fifo")).status().unwrap().success());
        std::os::unix::fs::symlink("/dev/zero", of("zero")).unwrap();
        std::os::unix::fs::symlink("fifo", of("link")).unwrap();
        for name in ["fifo", "link", "zero"] {
            let error = NamedFile::within(name, &of("b.gltf")).bytes().unwrap_err();
            assert!(matches!(error, Error::NotAFile { .. }), "{name}: {error}");
        }
        for path in [of("zero"), "/dev/zero".into(), folder.path().to_owned()] {
            let error = NamedFile::by_user(&path).bytes().unwrap_err();
            assert!(matches!(error, Error::NotAFile { .. }), "{error}");
        }
        let writer = of("fifo");
        let written = std::thread::spawn(move || std::fs::write(writer, "text"));
        assert_eq!(NamedFile::by_user(of("link")).text().unwrap(), "text");
        written.join().unwrap().unwrap();
    }
}
