//! The lock of a journal: a file beside it, which the process that adds results holds and is named in.

use std::fs::{self, File, OpenOptions, TryLockError};
use std::io::{self, Write as _};
use std::path::{Path, PathBuf};

use svbrdf_core::error::Error;

use crate::open::NamedFile;

/// How often a lock is tried that other processes remove at the same moment.
const TRIES: usize = 100;

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
    /// [`Error::JournalInUse`] where another process has it, [`Error::Unwritable`].
    pub(super) fn take(journal: &Path) -> Result<Self, Error> {
        let mut name = journal.as_os_str().to_owned();
        name.push(".lock");
        let path = PathBuf::from(name);
        let remedy = "check that the folder of the journal is writable";
        let unwritable = |source| Error::Unwritable { path: path.clone(), source, remedy };
        for _ in 0..TRIES {
            let options = OpenOptions::new().write(true).create(true).truncate(false).to_owned();
            let mut file = options.open(&path).map_err(unwritable)?;
            match file.try_lock() {
                Err(TryLockError::WouldBlock) => return Err(in_use(journal, &path)),
                // A file system without locks.
                Err(TryLockError::Error(e)) if e.kind() == io::ErrorKind::Unsupported => {}
                Err(TryLockError::Error(source)) => return Err(unwritable(source)),
                Ok(()) => {}
            }
            let owner = format!("process {}\n", std::process::id());
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
