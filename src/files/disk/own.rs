//! Files and folders that the program makes: new folders, and what it names itself, such as sidecar files, files of a results folder,
//! figures beside a page.
//!
//! Nobody chose what stands at such a name, so that only a regular file or a folder is used: a symbolic link, a pipe or a device
//! is refused.

use std::fs::{self, File};
use std::io::{self, BufWriter, Write as _};
use std::path::Path;

use svbrdf_core::progress::Progress;

use crate::disk::atomic::{self, CancelledWriter, folder_of};
use crate::error::Error;

/// Refuses a link, or anything else that is no regular file, at `path`.
///
/// # Errors
/// [`Error::Unwritable`].
pub fn check(path: &Path) -> Result<(), Error> {
    match fs::symlink_metadata(path) {
        Ok(found) if !found.is_file() => Err(refused(path, "regular file")),
        _ => Ok(()),
    }
}

/// Makes the folder `path` where there is none.
///
/// # Errors
/// [`Error::Unwritable`], also for a link to a folder.
pub fn folder(path: &Path) -> Result<(), Error> {
    match fs::symlink_metadata(path) {
        Ok(found) if found.is_dir() => Ok(()),
        Ok(_) => Err(refused(path, "folder")),
        Err(_) => fs::create_dir_all(path).map_err(|source| {
            let remedy = "check that the folder above it is there and writable";
            Error::Unwritable { path: path.to_owned(), source, remedy }
        }),
    }
}

fn refused(path: &Path, expected: &str) -> Error {
    let (problem, remedy) = match fs::read_link(path) {
        Ok(target) => (format!("it is a link to {}", target.display()), "remove the link"),
        Err(_) => (format!("it is no {expected}"), "remove it"),
    };
    Error::Unwritable { path: path.to_owned(), source: io::Error::other(problem), remedy }
}

/// Fills a temporary folder beside `path` by `fill`, and renames it. Only an empty folder gives way to it.
///
/// # Errors
/// Those of `fill`, and of the file system.
pub(crate) fn new_folder(
    path: &Path,
    progress: &Progress,
    fill: impl FnOnce(&Path) -> io::Result<()>,
) -> io::Result<()> {
    // Before the work; the rename refuses it in any case.
    if fs::read_dir(path).is_ok_and(|mut entries| entries.next().is_some()) {
        return Err(io::Error::new(io::ErrorKind::DirectoryNotEmpty, "it is a folder that is not empty"));
    }
    let temporary = tempfile::Builder::new().prefix(".svbrdf-").tempdir_in(folder_of(path))?;
    fill(temporary.path())?;
    atomic::check(progress)?;
    fs::rename(temporary.path(), path)?;
    #[cfg(unix)]
    fs::set_permissions(path, std::os::unix::fs::PermissionsExt::from_mode(0o755))?;
    let _ = temporary.keep();
    Ok(())
}

/// Writes a file of a folder that is not there yet, and brings it to the disk.
///
/// # Errors
/// Those of `write`, and of the file system.
pub(crate) fn new_file(
    path: &Path,
    progress: &Progress,
    write: impl FnOnce(&mut BufWriter<CancelledWriter<'_>>) -> io::Result<()>,
) -> io::Result<()> {
    let mut file = File::create(path)?;
    let mut buffer = BufWriter::new(CancelledWriter::new(&mut file, progress));
    write(&mut buffer)?;
    buffer.flush()?;
    drop(buffer);
    file.sync_all()
}

#[cfg(test)]
#[cfg(unix)]
mod tests {
    use std::os::unix::fs::symlink;

    use super::*;

    #[test]
    fn a_folder_is_made_and_no_link_to_one_is_used() {
        let above = tempfile::tempdir().unwrap();
        let of = |name: &str| above.path().join(name);
        folder(&of("new")).unwrap();
        folder(&of("new")).unwrap();
        symlink("new", of("link")).unwrap();
        fs::write(of("file"), "").unwrap();
        assert!(folder(&of("link")).unwrap_err().to_string().contains("a link to new"));
        assert!(folder(&of("file")).unwrap_err().to_string().contains("no folder"));
    }
}
