//! Writing of files that appear when they are complete, or not at all.

use std::fs::{self, File, OpenOptions};
use std::io::{self, BufWriter, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

use svbrdf_core::error::Error as CoreError;
use svbrdf_core::progress::Progress;

use crate::disk::inputs;
use crate::error::Error;

/// The program and its version, as the files that it writes name it.
pub const SOFTWARE: &str = concat!("svbrdf ", env!("CARGO_PKG_VERSION"));
/// A chain of links that is longer has no end.
const MOST_LINKS: usize = 40;

/// A file to be written, in a folder that is there.
#[derive(Clone, Debug)]
pub struct Destination {
    path: PathBuf,
    /// In small letters.
    extension: String,
}

impl Destination {
    /// Checks `path` before there is anything to write: it has one of the `extensions`. `what` names the extension in messages, and
    /// `known` lists all.
    ///
    /// # Errors
    /// [`CoreError::UnknownName`] for another extension; those of [`check_place`].
    pub fn new(
        path: &Path,
        extensions: &[&str],
        what: &'static str,
        known: impl Into<String>,
    ) -> Result<Self, Error> {
        let extension = path.extension().unwrap_or_default().to_string_lossy().to_lowercase();
        if !extensions.contains(&extension.as_str()) {
            return Err(CoreError::unknown_name(what, path.display().to_string(), known.into()).into());
        }
        check_place(path)?;
        Ok(Self { path: path.to_owned(), extension })
    }

    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Whether it has this extension.
    pub fn is(&self, extension: &str) -> bool {
        self.extension == extension
    }

    /// [`replace`] for this file.
    ///
    /// # Errors
    /// As [`replace`].
    pub fn replace(
        &self,
        progress: &Progress,
        write: impl FnOnce(&mut BufWriter<CancelledWriter<'_>>) -> io::Result<()>,
    ) -> Result<(), Error> {
        replace(&self.path, progress, write)
    }
}

/// A file that takes no more once the work is cancelled.
#[derive(Debug)]
pub struct CancelledWriter<'a> {
    file: &'a mut File,
    progress: &'a Progress,
}

impl<'a> CancelledWriter<'a> {
    pub fn new(file: &'a mut File, progress: &'a Progress) -> Self {
        Self { file, progress }
    }
}

impl Write for CancelledWriter<'_> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        check(self.progress)?;
        self.file.write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.file.flush()
    }
}

impl Seek for CancelledWriter<'_> {
    fn seek(&mut self, to: SeekFrom) -> io::Result<u64> {
        self.file.seek(to)
    }
}

/// An error once the work is cancelled.
pub fn check(progress: &Progress) -> io::Result<()> {
    // Not `Interrupted`, after which writing is tried again.
    if progress.is_cancelled() { Err(io::Error::other("cancelled")) } else { Ok(()) }
}

/// Checks that a file can be at `path`, before there is anything to write.
///
/// # Errors
/// [`Error::Unwritable`] where its folder is missing or it is itself a folder.
pub fn check_place(path: &Path) -> Result<(), Error> {
    check_folder(path)?;
    if path.is_dir() {
        let source = io::Error::new(io::ErrorKind::IsADirectory, "it is a folder");
        return Err(unwritable(path, source, "name a file"));
    }
    Ok(())
}

/// Checks that the folder is there in which a file or a folder will be.
///
/// # Errors
/// [`Error::Unwritable`] where it is missing.
pub fn check_folder(path: &Path) -> Result<(), Error> {
    if folder_of(path).is_dir() {
        return Ok(());
    }
    let source = io::Error::new(io::ErrorKind::NotFound, "its folder does not exist");
    Err(unwritable(path, source, "create the folder first, or name another"))
}

/// [`replace`] by a text.
///
/// # Errors
/// As [`replace`].
pub fn write_text(path: &Path, text: &str, progress: &Progress) -> Result<(), Error> {
    replace(path, progress, |file| file.write_all(text.as_bytes()))
}

/// Writes a file that a person named: a temporary file beside `path`, which is brought to the disk and renamed. At any moment,
/// even after a loss of power, the old file or the new one is there, whole.
///
/// A symbolic link stays, and what it points to is replaced, unless that is a protected input: whoever names a link means its
/// target. A device or a pipe stays, too: it is written to.
///
/// # Errors
/// [`Error::ReplacesInput`]; [`Error::Unwritable`]; [`Cancelled`](Error::is_cancelled), and then `path` is as it was.
pub fn replace(
    path: &Path,
    progress: &Progress,
    write: impl FnOnce(&mut BufWriter<CancelledWriter<'_>>) -> io::Result<()>,
) -> Result<(), Error> {
    inputs::check_output(path)?;
    written(path, progress, write)
}

/// [`replace`] for a file that the program reads, changes and writes again, such as a sidecar file. It is an input from then on.
///
/// # Errors
/// As [`replace`].
pub fn update(
    path: &Path,
    progress: &Progress,
    write: impl FnOnce(&mut BufWriter<CancelledWriter<'_>>) -> io::Result<()>,
) -> Result<(), Error> {
    written(path, progress, write)?;
    inputs::protect(path);
    Ok(())
}

fn written(
    path: &Path,
    progress: &Progress,
    write: impl FnOnce(&mut BufWriter<CancelledWriter<'_>>) -> io::Result<()>,
) -> Result<(), Error> {
    let fill = |file: &mut File| -> io::Result<()> {
        let mut buffer = BufWriter::new(CancelledWriter::new(file, progress));
        write(&mut buffer)?;
        buffer.flush()?;
        drop(buffer);
        check(progress)
    };
    let replaced = || -> io::Result<()> {
        if fs::metadata(path).is_ok_and(|there| !there.is_file() && !there.is_dir()) {
            // Formats go back to fill in lengths, which a pipe cannot.
            let mut whole = tempfile::tempfile()?;
            fill(&mut whole)?;
            whole.rewind()?;
            io::copy(&mut whole, &mut OpenOptions::new().write(true).open(path)?)?;
            return Ok(());
        }
        let target = target_of(path)?;
        temporary_in(folder_of(&target), fill)?.persist(&target)?;
        Ok(())
    };
    let remedy = "check that its folder is writable and the disk not full";
    replaced().map_err(|source| Error::unwritten(path, source, remedy, progress))
}

/// The target of `path` where it is a link: a file, or nothing yet.
fn target_of(path: &Path) -> io::Result<PathBuf> {
    let mut target = path.to_owned();
    for _ in 0..MOST_LINKS {
        match fs::read_link(&target) {
            Ok(next) => target = folder_of(&target).join(next),
            Err(_) => return Ok(target),
        }
    }
    Err(io::Error::other("its symbolic links go round in a circle"))
}

/// The folder of a file that may be named without one.
pub fn folder_of(path: &Path) -> &Path {
    match path.parent() {
        Some(folder) if folder != Path::new("") => folder,
        _ => Path::new("."),
    }
}

type Fill<'a> = Box<dyn FnOnce(&mut File) -> io::Result<()> + 'a>;

/// A temporary file that `fill` has filled, on the disk: its name must not lead to content that a loss of power takes away. It has the
/// permissions of any other new file, not of a secret. On Linux it has no name before, and a process that is killed leaves nothing.
fn temporary_in(
    folder: &Path,
    fill: impl FnOnce(&mut File) -> io::Result<()>,
) -> io::Result<tempfile::TempPath> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(".svbrdf-");
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    let mut fill: Fill<'_> = Box::new(fill);
    #[cfg(target_os = "linux")]
    if let Some(mut file) = unnamed(folder) {
        fill(&mut file)?;
        file.sync_all()?;
        if let Ok(named) = builder.make_in(folder, |path| name(&file, path)) {
            return Ok(named.into_temp_path());
        }
        // As without /proc.
        file.rewind()?;
        fill = Box::new(move |named| io::copy(&mut file, named).map(drop));
    }
    let mut named = builder.tempfile_in(folder)?;
    fill(named.as_file_mut())?;
    named.as_file().sync_all()?;
    Ok(named.into_temp_path())
}

/// A file without a name; `None` where the file system has none, as NFS.
#[cfg(target_os = "linux")]
fn unnamed(folder: &Path) -> Option<File> {
    use rustix::fs::{Mode, OFlags};
    let flags = OFlags::TMPFILE | OFlags::RDWR | OFlags::CLOEXEC;
    rustix::fs::open(folder, flags, Mode::from_raw_mode(0o666)).ok().map(File::from)
}

/// Gives a file without a name this one.
#[cfg(target_os = "linux")]
fn name(file: &File, path: &Path) -> io::Result<()> {
    use rustix::fs::{AtFlags, CWD};
    let own = format!("/proc/self/fd/{}", std::os::fd::AsRawFd::as_raw_fd(file));
    Ok(rustix::fs::linkat(CWD, own, CWD, path, AtFlags::SYMLINK_FOLLOW)?)
}

fn unwritable(path: &Path, source: io::Error, remedy: &'static str) -> Error {
    Error::Unwritable { path: path.to_owned(), source, remedy }
}

#[cfg(test)]
#[allow(clippy::disallowed_methods, reason = "a test reads its own files")]
mod tests {
    use super::*;

    #[test]
    fn a_failed_or_cancelled_write_leaves_nothing() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.png");
        let progress = Progress::default();
        let half_written = |then: &dyn Fn() -> io::Result<()>| {
            replace(&path, &progress, |file| file.write_all(b"half").and_then(|()| then()))
        };
        let failed = half_written(&|| Err(io::Error::other("disk full")));
        assert!(failed.unwrap_err().to_string().contains("disk full"));
        let cancel = || {
            progress.cancel();
            Ok(())
        };
        assert!(half_written(&cancel).is_err_and(|error| error.is_cancelled()));
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0);
    }

    #[cfg(unix)]
    #[test]
    fn links_stay_and_their_targets_are_replaced() {
        use std::os::unix::fs::symlink;
        let folder = tempfile::tempdir().unwrap();
        let of = |name: &str| folder.path().join(name);
        fs::create_dir(of("deep")).unwrap();
        fs::write(of("deep/old"), "old").unwrap();
        symlink("deep/link", of("first")).unwrap();
        symlink("old", of("deep/link")).unwrap();
        symlink("deep/none", of("dangling")).unwrap();
        symlink("circle", of("circle")).unwrap();
        let write = |name| {
            replace(&of(name), &Progress::default(), |file: &mut BufWriter<CancelledWriter<'_>>| {
                file.write_all(name.as_bytes())
            })
        };
        for (link, target) in [("first", "deep/old"), ("dangling", "deep/none")] {
            write(link).unwrap();
            assert!(of(link).is_symlink() && !of(target).is_symlink());
            assert_eq!(fs::read_to_string(of(target)).unwrap(), link);
        }
        assert!(write("circle").unwrap_err().to_string().contains("circle"));
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 4, "a temporary file is left");
    }
}
