//! Files and folders that the program itself names: locks, sidecar files, figures beside a page.
//!
//! Nobody chose what stands at such a name, so that only a regular file or a folder is used: a symbolic link, a pipe or a device
//! is refused. Of a file that is opened in place, such as a lock, a second name is refused, too.

use std::fs::{self, File, Metadata, OpenOptions};
use std::io;
use std::path::Path;

use svbrdf_core::error::Error;

/// Refuses a link, or anything else that is no regular file, at `path`.
///
/// # Errors
/// [`Error::Unwritable`].
pub(crate) fn check(path: &Path) -> Result<(), Error> {
    match fs::symlink_metadata(path) {
        Ok(found) if !found.is_file() => Err(refused(path, "regular file")),
        _ => Ok(()),
    }
}

/// Opens the file `path` to write into it, and creates it where there is none; it is not emptied.
///
/// # Errors
/// As [`check`]; where the file has a second name.
pub(crate) fn open(path: &Path) -> Result<File, Error> {
    check(path)?;
    let unwritable = |source| Error::Unwritable {
        path: path.to_owned(),
        source,
        remedy: "check that its folder is writable and the disk not full",
    };
    let file = opened(path).map_err(unwritable)?;
    let found = file.metadata().map_err(unwritable)?;
    if !found.is_file() {
        return Err(refused(path, "regular file"));
    }
    if has_second_name(&found) {
        let source = io::Error::other("it is a hard link, and has another name");
        return Err(Error::Unwritable { path: path.to_owned(), source, remedy: "remove this name of it" });
    }
    Ok(file)
}

/// Makes the folder `path` where there is none.
///
/// # Errors
/// [`Error::Unwritable`], also for a link to a folder.
pub(crate) fn folder(path: &Path) -> Result<(), Error> {
    match fs::symlink_metadata(path) {
        Ok(found) if found.is_dir() => Ok(()),
        Ok(_) => Err(refused(path, "folder")),
        Err(_) => fs::create_dir_all(path).map_err(|source| {
            let remedy = "check that the folder above it is there and writable";
            Error::Unwritable { path: path.to_owned(), source, remedy }
        }),
    }
}

/// The open file. A link that has taken its place is not followed, and a pipe not waited for.
fn opened(path: &Path) -> io::Result<File> {
    let mut options = OpenOptions::new();
    #[cfg(unix)]
    {
        use rustix::fs::OFlags;
        use std::os::unix::fs::OpenOptionsExt as _;
        options.custom_flags((OFlags::NOFOLLOW | OFlags::NONBLOCK).bits().cast_signed());
    }
    options.write(true).create(true).truncate(false).open(path)
}

#[cfg(unix)]
fn has_second_name(found: &Metadata) -> bool {
    std::os::unix::fs::MetadataExt::nlink(found) > 1
}

/// Windows does not tell without unsafe code.
#[cfg(not(unix))]
fn has_second_name(_: &Metadata) -> bool {
    false
}

/// The error of a path that is not as `expected`.
fn refused(path: &Path, expected: &str) -> Error {
    let (problem, remedy) = match fs::read_link(path) {
        Ok(target) => (format!("it is a link to {}", target.display()), "remove the link"),
        Err(_) => (format!("it is no {expected}"), "remove it"),
    };
    Error::Unwritable { path: path.to_owned(), source: io::Error::other(problem), remedy }
}

#[cfg(test)]
#[cfg(unix)]
mod tests {
    use std::os::unix::fs::symlink;

    use super::*;

    #[test]
    fn only_a_regular_file_with_one_name_is_opened_and_nothing_is_waited_for() {
        let folder = tempfile::tempdir().unwrap();
        let of = |name: &str| folder.path().join(name);
        fs::write(of("precious"), "kept").unwrap();
        symlink("precious", of("soft")).unwrap();
        symlink("none", of("dangling")).unwrap();
        fs::hard_link(of("precious"), of("hard")).unwrap();
        assert!(std::process::Command::new("mkfifo").arg(of("fifo")).status().unwrap().success());
        for name in ["soft", "dangling", "hard", "fifo", "."] {
            let error = open(&of(name)).unwrap_err().to_string();
            assert!(error.contains("cannot write") && error.contains("remove"), "{name}: {error}");
        }
        assert_eq!(fs::metadata(of("precious")).unwrap().len(), 4);
        assert!(!of("none").exists());
        open(&of("new")).unwrap();
        open(&of("new")).unwrap();
    }

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
