//! Files that change on disk, detected on a thread of their own: the window is drawn again only after a change.

use std::collections::{HashMap, HashSet};
use std::path::PathBuf;
use std::sync::mpsc::{self, Receiver, RecvTimeoutError, Sender};
use std::time::{Duration, SystemTime};

use eframe::egui;

use super::loaded::changed;
use super::slots::Slots;

/// Time between two checks.
const INTERVAL: Duration = Duration::from_secs(1);

/// The files of each material, by its id, with the times of their last change when they were read.
type Files = Vec<(u64, Vec<(PathBuf, Option<SystemTime>)>)>;

/// What has happened to the files of a material.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Change {
    /// They have changed.
    Changed,
    /// This one is gone.
    Gone(PathBuf),
    /// One that was gone is back, unchanged.
    Back,
}

/// Checks the files of all materials once a second.
#[derive(Debug, Default)]
pub(super) struct Watch {
    watcher: Option<Watcher>,
    ids: Vec<u64>,
}

impl Watch {
    /// What has happened since the last call, each with the index of the material.
    pub(super) fn poll(&mut self, ctx: &egui::Context, slots: &Slots) -> Vec<(usize, Change)> {
        let ids: Vec<u64> = slots.slots.iter().map(|slot| slot.id).collect();
        if self.watcher.is_none() || self.ids != ids {
            let watcher = self.watcher.get_or_insert_with(|| Watcher::start(ctx, INTERVAL));
            watcher.watch(slots.slots.iter().map(|slot| (slot.id, slot.loaded.files.clone())).collect());
            self.ids = ids;
        }
        let changes = self.watcher.iter().flat_map(Watcher::changes);
        let index = |id| slots.slots.iter().position(|slot| slot.id == id);
        changes.filter_map(|(id, change)| Some((index(id)?, change))).collect()
    }

    /// Ends the checks.
    pub(super) fn stop(&mut self) {
        *self = Self::default();
    }
}

/// The thread that checks; it ends when this is dropped.
#[derive(Debug)]
struct Watcher {
    files: Sender<Files>,
    changes: Receiver<(u64, Change)>,
}

impl Watcher {
    fn start(ctx: &egui::Context, interval: Duration) -> Self {
        let (files, new_files) = mpsc::channel();
        let (sender, changes) = mpsc::channel();
        let ctx = ctx.clone();
        std::thread::spawn(move || {
            let mut check = Check::default();
            loop {
                match new_files.recv_timeout(interval) {
                    Ok(files) => check.files = files,
                    Err(RecvTimeoutError::Timeout) => {}
                    Err(RecvTimeoutError::Disconnected) => return,
                }
                for change in check.changes() {
                    if sender.send(change).is_err() {
                        return;
                    }
                    ctx.request_repaint();
                }
            }
        });
        Self { files, changes }
    }

    /// Watches these files in place of the earlier ones.
    fn watch(&self, files: Files) {
        // The thread ends only with this watcher.
        let _ = self.files.send(files);
    }

    /// What has happened since the last call, each with the id of the material.
    fn changes(&self) -> Vec<(u64, Change)> {
        self.changes.try_iter().collect()
    }
}

/// The watched files, and the changes that have been reported.
#[derive(Debug, Default)]
struct Check {
    files: Files,
    reported: HashMap<PathBuf, SystemTime>,
    gone: HashSet<PathBuf>,
}

impl Check {
    /// What has happened to each material since the last call: a file has changed since it was read and since it was last
    /// reported, is gone, or is back.
    fn changes(&mut self) -> Vec<(u64, Change)> {
        let mut changes = Vec::new();
        for (id, files) in &self.files {
            let (mut is_changed, mut is_back, mut gone) = (false, false, None);
            for (path, read) in files {
                let Some(now) = changed(path) else {
                    if self.gone.insert(path.clone()) {
                        gone = Some(path.clone());
                    }
                    continue;
                };
                is_back |= self.gone.remove(path);
                if Some(now) != *read {
                    is_changed |= self.reported.insert(path.clone(), now) != Some(now);
                }
            }
            let change = match gone {
                Some(path) => Some(Change::Gone(path)),
                None if is_changed => Some(Change::Changed),
                None => is_back.then_some(Change::Back),
            };
            changes.extend(change.map(|change| (*id, change)));
        }
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

    /// A file of time 1000 s that was read at that time, watched as that of material 7.
    fn watched(folder: &tempfile::TempDir) -> (PathBuf, Files) {
        let path = folder.path().join("map.png");
        std::fs::write(&path, "a").unwrap();
        set_time(&path, 1000);
        let files = vec![(7, vec![(path.clone(), changed(&path))])];
        (path, files)
    }

    #[test]
    fn a_change_is_reported_once_and_so_is_the_next_one() {
        let folder = tempfile::tempdir().unwrap();
        let (path, files) = watched(&folder);
        let mut check = Check { files, ..Check::default() };
        assert!(check.changes().is_empty());
        set_time(&path, 2000);
        assert_eq!(check.changes(), [(7, Change::Changed)]);
        assert!(check.changes().is_empty(), "it is reported already");
        set_time(&path, 3000);
        assert_eq!(check.changes(), [(7, Change::Changed)]);
    }

    #[test]
    fn a_file_that_is_gone_is_reported_once_and_again_when_it_is_back() {
        let folder = tempfile::tempdir().unwrap();
        let (path, files) = watched(&folder);
        let mut check = Check { files, ..Check::default() };
        std::fs::remove_file(&path).unwrap();
        assert_eq!(check.changes(), [(7, Change::Gone(path.clone()))]);
        assert!(check.changes().is_empty(), "it is reported already");
        std::fs::write(&path, "a").unwrap();
        set_time(&path, 1000);
        assert_eq!(check.changes(), [(7, Change::Back)], "it is as it was read");
        std::fs::remove_file(&path).unwrap();
        assert_eq!(check.changes(), [(7, Change::Gone(path.clone()))]);
        std::fs::write(&path, "b").unwrap();
        assert_eq!(check.changes(), [(7, Change::Changed)], "it is there again, and another");
    }

    #[test]
    fn the_window_is_drawn_again_after_a_change_and_not_before() {
        let folder = tempfile::tempdir().unwrap();
        let (path, files) = watched(&folder);
        let (ctx, repaints) = (egui::Context::default(), Arc::new(AtomicUsize::new(0)));
        let counted = repaints.clone();
        ctx.set_request_repaint_callback(move |_| {
            counted.fetch_add(1, Ordering::SeqCst);
        });
        let watcher = Watcher::start(&ctx, Duration::from_millis(1));
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
        assert_eq!((repaints.load(Ordering::SeqCst), stale), (1, vec![(7, Change::Changed)]));
    }
}
