//! New folders, which appear when they are complete, or not at all.

use std::fs::{self, File};
use std::io::{self, BufWriter, Write as _};
use std::path::Path;

use svbrdf_core::progress::Progress;

use crate::disk::atomic::{CancelledWriter, check, folder_of};

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
    check(progress)?;
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
