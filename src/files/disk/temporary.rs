//! Temporary files, which become the files of their folder once they are whole.
//!
//! On most file systems of Linux they have no name until then, and a process that is killed leaves nothing of them.

use std::fs::File;
use std::io::{self, Seek as _};
use std::path::Path;

/// How the names of temporary files begin.
const TEMPORARY: &str = ".svbrdf-";

/// A temporary file that `fill` has filled, and that is on the disk: a name must not lead to content that a loss of power takes away.
/// Where it can, it has no name until then.
pub(super) fn filled(
    folder: &Path,
    fill: impl FnOnce(&mut File) -> io::Result<()>,
) -> io::Result<tempfile::TempPath> {
    let Some(mut file) = unnamed(folder) else { return filled_by_name(folder, fill) };
    fill(&mut file)?;
    file.sync_all()?;
    let named = tempfile::Builder::new().prefix(TEMPORARY).make_in(folder, |path| name(&file, path));
    if let Ok(named) = named {
        return Ok(named.into_temp_path());
    }
    file.rewind()?;
    filled_by_name(folder, |copy| io::copy(&mut file, copy).map(drop))
}

/// A temporary file that has a name from the start, with the permissions of any other new file, not of a secret.
fn filled_by_name(
    folder: &Path,
    fill: impl FnOnce(&mut File) -> io::Result<()>,
) -> io::Result<tempfile::TempPath> {
    let mut builder = tempfile::Builder::new();
    #[cfg(unix)]
    let permissions = std::os::unix::fs::PermissionsExt::from_mode(0o666);
    #[cfg(unix)]
    builder.permissions(permissions);
    let mut temporary = builder.prefix(TEMPORARY).tempfile_in(folder)?;
    fill(temporary.as_file_mut())?;
    temporary.as_file().sync_all()?;
    Ok(temporary.into_temp_path())
}

/// A file without a name on the file system of `folder`, with the permissions of any other new file; `None` where there are none.
#[cfg(target_os = "linux")]
fn unnamed(folder: &Path) -> Option<File> {
    use rustix::fs::{Mode, OFlags};
    let flags = OFlags::TMPFILE | OFlags::RDWR | OFlags::CLOEXEC;
    rustix::fs::open(folder, flags, Mode::from_raw_mode(0o666)).ok().map(File::from)
}

/// Gives it a name that nothing has.
///
/// # Errors
/// [`io::ErrorKind::AlreadyExists`]; those of systems that do not allow it.
#[cfg(target_os = "linux")]
fn name(file: &File, path: &Path) -> io::Result<()> {
    use rustix::fs::{AtFlags, CWD, linkat};
    use std::os::fd::AsRawFd as _;
    let own = format!("/proc/self/fd/{}", file.as_raw_fd());
    Ok(linkat(CWD, own, CWD, path, AtFlags::SYMLINK_FOLLOW)?)
}

#[cfg(not(target_os = "linux"))]
fn unnamed(_: &Path) -> Option<File> {
    None
}

#[cfg(not(target_os = "linux"))]
fn name(_: &File, _: &Path) -> io::Result<()> {
    Err(io::ErrorKind::Unsupported.into())
}

#[cfg(test)]
#[allow(clippy::disallowed_methods, reason = "a test reads its own files")]
mod tests {
    use std::fs;
    use std::io::{BufWriter, Write as _};

    use super::*;
    use crate::disk::atomic::{CancelledWriter, replace};
    use svbrdf_core::progress::Progress;

    /// Killed at any moment until then, the process leaves nothing.
    #[test]
    fn a_file_has_no_name_until_it_is_whole() {
        let folder = tempfile::tempdir().unwrap();
        let count = || fs::read_dir(folder.path()).unwrap().count();
        if unnamed(folder.path()).is_none() {
            return;
        }
        let path = folder.path().join("a.png");
        for text in ["first", "second"] {
            let before = count();
            let write = |file: &mut BufWriter<CancelledWriter<'_>>| {
                assert_eq!(count(), before);
                file.write_all(text.as_bytes())
            };
            replace(&path, &Progress::default(), write).unwrap();
            assert_eq!((fs::read_to_string(&path).unwrap().as_str(), count()), (text, 1));
        }
    }
}
