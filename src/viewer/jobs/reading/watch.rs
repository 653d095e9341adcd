//! Watch over the files of the materials: the window is drawn again only after a change.
//!
//! A file that is being written is left alone: a change counts once the file is the same in two checks, or was written a while ago.

use std::collections::{HashMap, HashSet};
use std::path::PathBuf;
use std::sync::mpsc::{self, RecvTimeoutError, Sender};
use std::time::{Duration, SystemTime};

use svbrdf_files::disk::stamp::Stamp;

use crate::jobs::work::job::Job;
use crate::jobs::work::waker::Waker;
use crate::model::material::list::MaterialList;
use crate::model::material::loaded::LoadedMaterial;
use crate::model::material::read::MaterialId;

/// Time between two checks.
pub const INTERVAL: Duration = Duration::from_secs(1);
/// A file that was written before this time is complete.
pub const QUIET: Duration = Duration::from_secs(3);

/// The files of each material, by its id, with their stamps when they were read.
type Files = Vec<(MaterialId, Vec<(PathBuf, Option<Stamp>)>)>;

/// What has happened to the files of a material.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum FileChange {
    /// They have changed.
    Changed,
    /// This one is gone.
    Gone(PathBuf),
    /// One that was gone is back, unchanged.
    Back,
}

/// Checks the files of all materials once a second.
#[derive(Debug, Default)]
pub struct FileWatch {
    watcher: Option<Watcher>,
    ids: Vec<MaterialId>,
}

impl FileWatch {
    /// What has happened since the last call, each with the index of the material.
    pub fn poll(&mut self, waker: &Waker, materials: &MaterialList) -> Vec<(usize, FileChange)> {
        let ids: Vec<MaterialId> = materials.all.iter().map(LoadedMaterial::id).collect();
        if self.watcher.is_none() || self.ids != ids {
            let watcher = self.watcher.get_or_insert_with(|| Watcher::start(waker, INTERVAL));
            watcher.watch(materials.all.iter().map(|one| (one.id(), one.read.files())).collect());
            self.ids = ids;
        }
        let changes = self.watcher.iter().flat_map(Watcher::changes);
        let index = |id| materials.all.iter().position(|one| one.id() == id);
        changes.filter_map(|(id, change)| Some((index(id)?, change))).collect()
    }

    /// Ends the checks.
    pub fn stop(&mut self) {
        *self = Self::default();
    }
}

/// The thread that checks; it ends when this is dropped.
#[derive(Debug)]
struct Watcher {
    files: Sender<Files>,
    job: Job<(), (MaterialId, FileChange)>,
}

impl Watcher {
    fn start(waker: &Waker, interval: Duration) -> Self {
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
        Self { files, job }
    }

    /// Watches these files in place of the earlier ones.
    fn watch(&self, files: Files) {
        // The thread ends only with this watcher.
        let _ = self.files.send(files);
    }

    /// What has happened since the last call, each with the id of the material.
    fn changes(&self) -> Vec<(MaterialId, FileChange)> {
        self.job.updates()
    }
}

/// The watched files, and the changes that have been reported.
#[derive(Debug, Default)]
struct Check {
    files: Files,
    reported: HashMap<PathBuf, Stamp>,
    /// As they were at the last check.
    latest: HashMap<PathBuf, Stamp>,
    /// Not there at the last check: a file that is replaced may be missing for a moment.
    missing: HashSet<PathBuf>,
    /// Reported to be gone.
    gone: HashSet<PathBuf>,
}

impl Check {
    /// What has happened to each material since the last call: a file has changed since it was read and since it was last
    /// reported, is gone for two checks, or is back. A material with a file that is being written has not changed yet.
    fn changes(&mut self) -> Vec<(MaterialId, FileChange)> {
        let now = SystemTime::now();
        let (mut latest, mut missing) = (HashMap::new(), HashSet::new());
        let mut changes = Vec::new();
        for (id, files) in &self.files {
            let (mut changed, mut is_still, mut is_back, mut gone) = (Vec::new(), true, false, None);
            for (path, read) in files {
                let Some(stamp) = Stamp::of(path) else {
                    missing.insert(path.clone());
                    if self.missing.contains(path) && self.gone.insert(path.clone()) {
                        gone = Some(path.clone());
                    }
                    continue;
                };
                is_back |= self.gone.remove(path);
                is_still &= self.latest.get(path) == Some(&stamp) || !stamp.is_younger_than(QUIET, now);
                latest.insert(path.clone(), stamp);
                if Some(stamp) != *read && self.reported.get(path) != Some(&stamp) {
                    changed.push((path.clone(), stamp));
                }
            }
            let change = match gone {
                Some(path) => Some(FileChange::Gone(path)),
                None if changed.is_empty() => is_back.then_some(FileChange::Back),
                None if is_still => {
                    self.reported.extend(changed);
                    Some(FileChange::Changed)
                }
                None => None,
            };
            changes.extend(change.map(|change| (*id, change)));
        }
        (self.latest, self.missing) = (latest, missing);
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

    /// The id of the material.
    fn id() -> MaterialId {
        MaterialId::numbered(7)
    }

    /// A file written and read at 1000 s, watched for the material.
    fn watched(folder: &tempfile::TempDir) -> (PathBuf, Files) {
        let path = folder.path().join("map.png");
        std::fs::write(&path, "a").unwrap();
        set_time(&path, 1000);
        let files = vec![(id(), vec![(path.clone(), Stamp::of(&path))])];
        (path, files)
    }

    #[test]
    fn a_change_is_reported_once_and_so_is_the_next_one() {
        let folder = tempfile::tempdir().unwrap();
        let (path, files) = watched(&folder);
        let mut check = Check { files, ..Check::default() };
        assert!(check.changes().is_empty());
        set_time(&path, 2000);
        assert_eq!(check.changes(), [(id(), FileChange::Changed)]);
        assert!(check.changes().is_empty(), "it is reported already");
        set_time(&path, 3000);
        assert_eq!(check.changes(), [(id(), FileChange::Changed)]);
    }

    #[test]
    fn a_file_that_is_gone_is_reported_once_and_again_when_it_is_back() {
        let folder = tempfile::tempdir().unwrap();
        let (path, files) = watched(&folder);
        let mut check = Check { files, ..Check::default() };
        std::fs::remove_file(&path).unwrap();
        assert!(check.changes().is_empty(), "it may be replaced");
        assert_eq!(check.changes(), [(id(), FileChange::Gone(path.clone()))]);
        assert!(check.changes().is_empty(), "it is reported already");
        std::fs::write(&path, "a").unwrap();
        set_time(&path, 1000);
        assert_eq!(check.changes(), [(id(), FileChange::Back)], "it is as it was read");
        std::fs::remove_file(&path).unwrap();
        assert!(check.changes().is_empty());
        assert_eq!(check.changes(), [(id(), FileChange::Gone(path.clone()))]);
        std::fs::write(&path, "b").unwrap();
        assert!(check.changes().is_empty(), "it may still be written");
        assert_eq!(check.changes(), [(id(), FileChange::Changed)], "it is there again, and another");
    }

    #[test]
    fn a_file_that_is_being_written_has_not_changed_until_it_stands_still() {
        let folder = tempfile::tempdir().unwrap();
        let (path, files) = watched(&folder);
        let mut check = Check { files, ..Check::default() };
        for size in 2..6 {
            std::fs::write(&path, "a".repeat(size)).unwrap();
            assert!(check.changes().is_empty(), "it grows: {size} bytes");
        }
        assert_eq!(check.changes(), [(id(), FileChange::Changed)]);
        assert!(check.changes().is_empty(), "it is reported already");
        // Of the same size, a moment ago.
        std::fs::write(&path, "bbbbb").unwrap();
        assert!(check.changes().is_empty());
        assert_eq!(check.changes(), [(id(), FileChange::Changed)]);
    }

    #[test]
    fn the_window_is_drawn_again_after_a_change_and_not_before() {
        let folder = tempfile::tempdir().unwrap();
        let (path, files) = watched(&folder);
        let repaints = Arc::new(AtomicUsize::new(0));
        let counted = repaints.clone();
        let waker = Waker::new(move |_| {
            counted.fetch_add(1, Ordering::SeqCst);
        });
        let watcher = Watcher::start(&waker, Duration::from_millis(1));
        watcher.watch(files);
        std::thread::sleep(Duration::from_millis(50));
        assert_eq!((repaints.load(Ordering::SeqCst), watcher.changes()), (0, vec![]));
        set_time(&path, 2000);
        let mut stale = Vec::new();
        for _ in 0..2000 {
            stale.extend(watcher.changes());
            if !stale.is_empty() && repaints.load(Ordering::SeqCst) > 0 {
                break;
            }
            std::thread::sleep(Duration::from_millis(5));
        }
        assert_eq!((repaints.load(Ordering::SeqCst), stale), (1, vec![(id(), FileChange::Changed)]));
    }
}
