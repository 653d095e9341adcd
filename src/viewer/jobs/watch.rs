//! Watch over the files of the materials: the window is drawn again only after a change.
//!
//! A file that is being written is left alone: a change counts once the file is the same in two checks, or was written a while ago.

use std::collections::HashMap;
use std::path::PathBuf;
use std::sync::mpsc::{self, RecvTimeoutError, Sender};
use std::time::{Duration, SystemTime};

use svbrdf_files::disk::stamp::Stamp;

use crate::jobs::work::Job;
use crate::jobs::work::Waker;
use crate::model::material::read::MaterialId;

/// Time between two checks.
pub const INTERVAL: Duration = Duration::from_secs(1);
/// A file that was written before this time is complete.
pub const QUIET: Duration = Duration::from_secs(3);

/// What files are of.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Watched {
    Material(MaterialId),
    /// A row of the table in sight, and the address of what was read of it.
    Row(usize, usize),
}

/// The files with their stamps when they were read.
pub type Files = Vec<(PathBuf, Option<Stamp>)>;
type AllFiles = Vec<(Watched, Files)>;

/// Checks files once a second, on a thread that ends when this is dropped.
#[derive(Debug, Default)]
pub struct FileWatch {
    thread: Option<(Sender<AllFiles>, Job<(), Watched>)>,
    watched: Vec<Watched>,
}

impl FileWatch {
    /// Those of `watched` with files, which `files` tells of all, that have changed since the last call.
    pub fn poll(
        &mut self,
        waker: &Waker,
        watched: Vec<Watched>,
        files: impl FnOnce() -> Vec<Files>,
    ) -> Vec<Watched> {
        let (sender, job) = self.thread.get_or_insert_with(|| watch(waker, INTERVAL));
        if self.watched != watched {
            // The thread ends only with this watch.
            let _ = sender.send(watched.iter().copied().zip(files()).collect());
            self.watched = watched;
        }
        job.updates().into_iter().filter(|one| self.watched.contains(one)).collect()
    }
}

/// Starts to watch the files that are sent, in place of the earlier ones.
fn watch(waker: &Waker, interval: Duration) -> (Sender<AllFiles>, Job<(), Watched>) {
    let (files, new_files) = mpsc::channel();
    let job = Job::watch(waker, move |worker| {
        let mut check = Check::default();
        loop {
            match new_files.recv_timeout(interval) {
                Ok(files) => check.files = files,
                Err(RecvTimeoutError::Timeout) => {}
                Err(RecvTimeoutError::Disconnected) => return Ok(()),
            }
            check.changes().into_iter().try_for_each(|change| worker.report(change))?;
        }
    });
    (files, job)
}

/// The watched files, and the changes that have been reported.
#[derive(Debug, Default)]
struct Check {
    files: AllFiles,
    reported: HashMap<PathBuf, Stamp>,
    /// As they were at the last check.
    latest: HashMap<PathBuf, Stamp>,
}

impl Check {
    /// Those with a file that has changed since it was read and since it was last reported. Those with a file that is being written, or
    /// that is not there, have not changed yet.
    fn changes(&mut self) -> Vec<Watched> {
        let now = SystemTime::now();
        let (mut latest, mut changes, mut reported) = (HashMap::new(), Vec::new(), Vec::new());
        for (id, files) in &self.files {
            let (mut changed, mut is_still) = (Vec::new(), true);
            for (path, read) in files {
                let Some(stamp) = Stamp::of(path) else { continue };
                is_still &= self.latest.get(path) == Some(&stamp) || !stamp.is_younger_than(QUIET, now);
                latest.insert(path.clone(), stamp);
                if Some(stamp) != *read && self.reported.get(path) != Some(&stamp) {
                    changed.push((path.clone(), stamp));
                }
            }
            if is_still && !changed.is_empty() {
                reported.extend(changed);
                changes.push(*id);
            }
        }
        // A file may be of several.
        self.reported.extend(reported);
        self.latest = latest;
        changes
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;
    use std::sync::atomic::{AtomicUsize, Ordering};

    use super::*;

    fn set_time(path: &std::path::Path, seconds: u64) {
        let time = SystemTime::UNIX_EPOCH + Duration::from_secs(seconds);
        std::fs::File::options().write(true).open(path).unwrap().set_modified(time).unwrap();
    }

    /// A file written and read at 1000 s, watched for a material.
    fn watched(folder: &tempfile::TempDir) -> (PathBuf, AllFiles) {
        let path = folder.path().join("map.png");
        std::fs::write(&path, "a").unwrap();
        set_time(&path, 1000);
        let files = vec![(path.clone(), Stamp::of(&path))];
        let files = vec![(Watched::Material(MaterialId::next()), files.clone()), (Watched::Row(0, 0), files)];
        (path, files)
    }

    #[test]
    fn a_change_is_reported_once_and_when_the_file_stands_still() {
        let folder = tempfile::tempdir().unwrap();
        let (path, files) = watched(&folder);
        let mut check = Check { files, ..Check::default() };
        // What is done to the file before a check, and whether that reports a change.
        let touch = |seconds: u64| set_time(&path, seconds);
        let write = |text: &str| std::fs::write(&path, text).unwrap();
        let events: [(&dyn Fn(), bool); 11] = [
            (&|| (), false),
            (&|| touch(2000), true),
            (&|| (), false),
            (&|| touch(3000), true),
            // It may be replaced.
            (&|| std::fs::remove_file(&path).unwrap(), false),
            (&|| write("aa"), false),
            (&|| write("aaa"), false),
            (&|| (), true),
            // Of the same size, a moment ago.
            (&|| write("bbb"), false),
            (&|| (), true),
            (&|| (), false),
        ];
        for (step, (event, is_reported)) in events.into_iter().enumerate() {
            event();
            assert_eq!(check.changes().len(), if is_reported { 2 } else { 0 }, "{step}");
        }
    }

    #[test]
    fn the_window_is_drawn_again_after_a_change_and_not_before() {
        let folder = tempfile::tempdir().unwrap();
        let (path, files) = watched(&folder);
        let id = files[0].0;
        let repaints = Arc::new(AtomicUsize::new(0));
        let counted = repaints.clone();
        let waker = Waker::new(move |_| {
            counted.fetch_add(1, Ordering::SeqCst);
        });
        let (sender, job) = watch(&waker, Duration::from_millis(1));
        sender.send(files[..1].to_vec()).unwrap();
        std::thread::sleep(Duration::from_millis(50));
        assert_eq!((repaints.load(Ordering::SeqCst), job.updates()), (0, vec![]));
        set_time(&path, 2000);
        let mut stale = Vec::new();
        for _ in 0..2000 {
            stale.extend(job.updates());
            if !stale.is_empty() && repaints.load(Ordering::SeqCst) > 0 {
                break;
            }
            std::thread::sleep(Duration::from_millis(5));
        }
        assert_eq!((repaints.load(Ordering::SeqCst), stale), (1, vec![id]));
    }
}
