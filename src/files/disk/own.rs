//! Files and folders that the program itself names: sidecar files, files of a results folder, figures beside a page.
//!
//! Nobody chose what stands at such a name, so that only a regular file or a folder is used: a symbolic link, a pipe or a device
//! is refused.

use std::fs;
use std::io;
use std::path::Path;

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
