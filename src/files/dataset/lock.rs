//! The lock of a journal: a file beside it, which the process that adds results holds and is named in.

use std::fs::{self, File, TryLockError};
use std::io::{self, Read as _, Write as _};
use std::path::{Path, PathBuf};

use svbrdf_core::error::Error;

use crate::open::NamedFile;
use crate::own;

/// How often a lock is tried that other processes remove at the same moment.
const TRIES: usize = 100;
/// How the text of a lock begins.
const OWNER: &str = "process ";

/// The lock of a journal, until it is dropped.
#[derive(Debug)]
pub(super) struct Lock {
    path: PathBuf,
    _file: File,
}

impl Lock {
    /// Takes the lock of the journal `journal`.
    ///
    /// # Errors
    /// [`Error::JournalInUse`] where another process has it; [`Error::Unwritable`], also where the name of the lock is a link or
    /// another file.
    pub(super) fn take(journal: &Path) -> Result<Self, Error> {
        let mut name = journal.as_os_str().to_owned();
        name.push(".lock");
        let path = PathBuf::from(name);
        let remedy = "check that the folder of the journal is writable";
        let unwritable = |source| Error::Unwritable { path: path.clone(), source, remedy };
        for _ in 0..TRIES {
            check_content(&path, journal)?;
            let mut file = own::open(&path)?;
            match file.try_lock() {
                Err(TryLockError::WouldBlock) => return Err(in_use(journal, &path)),
                // A file system without locks.
                Err(TryLockError::Error(e)) if e.kind() == io::ErrorKind::Unsupported => {}
                Err(TryLockError::Error(source)) => return Err(unwritable(source)),
                Ok(()) => {}
            }
            let owner = format!("{OWNER}{}\n", std::process::id());
            let written = file.set_len(0).and_then(|()| file.write_all(owner.as_bytes()));
            written.map_err(unwritable)?;
            // Not one that its last owner has removed meanwhile. Windows lets nobody read a locked file.
            if cfg!(windows) || NamedFile::by_file(&path, journal).text().is_ok_and(|found| found == owner) {
                return Ok(Self { path, _file: file });
            }
        }
        Err(in_use(journal, &path))
    }
}

impl Drop for Lock {
    fn drop(&mut self) {
        // While it is still held: nobody else can be its owner.
        let _ = fs::remove_file(&self.path);
    }
}

/// Refuses to take a file that holds something else for a lock.
///
/// # Errors
/// [`Error::Unwritable`]; as [`own::check`].
fn check_content(path: &Path, journal: &Path) -> Result<(), Error> {
    own::check(path)?;
    // There is none, or another process has locked it.
    let Ok(file) = NamedFile::by_file(path, journal).open() else { return Ok(()) };
    let mut start = Vec::new();
    let read = file.take(OWNER.len() as u64).read_to_end(&mut start);
    if read.is_err() || OWNER.as_bytes().starts_with(&start) {
        return Ok(());
    }
    let source = io::Error::other("it is no lock, although the lock of the journal has this name");
    Err(Error::Unwritable { path: path.to_owned(), source, remedy: "name another journal" })
}

fn in_use(journal: &Path, lock: &Path) -> Error {
    let owner = NamedFile::by_file(lock, journal).text().unwrap_or_default();
    let owner = if owner.trim().is_empty() { "another process" } else { owner.trim() };
    Error::JournalInUse { path: journal.to_owned(), owner: owner.to_owned() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_journal_has_one_writer_which_is_named() {
        let folder = tempfile::tempdir().unwrap();
        let journal = folder.path().join("run.jsonl");
        let first = Lock::take(&journal).unwrap();
        let error = Lock::take(&journal).unwrap_err().to_string();
        if cfg!(unix) {
            assert!(error.contains(&format!("process {}", std::process::id())), "{error}");
        }
        drop(first);
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0, "the lock is left");
        Lock::take(&journal).unwrap();
    }

    #[test]
    fn a_lock_that_a_killed_process_left_is_taken() {
        let folder = tempfile::tempdir().unwrap();
        let journal = folder.path().join("run.jsonl");
        fs::write(folder.path().join("run.jsonl.lock"), "process 1 that was killed\n").unwrap();
        Lock::take(&journal).unwrap();
    }

    #[test]
    fn of_many_that_take_it_at_once_one_has_it() {
        let folder = tempfile::tempdir().unwrap();
        let journal = folder.path().join("run.jsonl");
        let owners = std::sync::atomic::AtomicUsize::new(0);
        std::thread::scope(|scope| {
            for _ in 0..8 {
                scope.spawn(|| {
                    for _ in 0..200 {
                        if let Ok(lock) = Lock::take(&journal) {
                            assert_eq!(owners.fetch_add(1, std::sync::atomic::Ordering::SeqCst), 0);
                            owners.fetch_sub(1, std::sync::atomic::Ordering::SeqCst);
                            drop(lock);
                        }
                    }
                });
            }
        });
    }
}
