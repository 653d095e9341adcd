//! Files that change on disk, detected on a thread of their own: the window is drawn again only after a change.

use std::collections::HashMap;
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

/// Checks the files of all materials once a second.
#[derive(Debug, Default)]
pub struct Watch {
    watcher: Option<Watcher>,
    ids: Vec<u64>,
}

impl Watch {
    /// The indices of the materials whose files have changed since the last call.
    pub fn poll(&mut self, ctx: &egui::Context, slots: &Slots) -> Vec<usize> {
        let ids: Vec<u64> = slots.slots.iter().map(|slot| slot.id).collect();
        if self.watcher.is_none() || self.ids != ids {
            let watcher = self.watcher.get_or_insert_with(|| Watcher::start(ctx, INTERVAL));
            watcher.watch(slots.slots.iter().map(|slot| (slot.id, slot.loaded.files.clone())).collect());
            self.ids = ids;
        }
        let stale = self.watcher.iter().flat_map(Watcher::stale);
        stale.filter_map(|id| slots.slots.iter().position(|slot| slot.id == id)).collect()
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
    stale: Receiver<u64>,
}

impl Watcher {
    fn start(ctx: &egui::Context, interval: Duration) -> Self {
        let (files, new_files) = mpsc::channel();
        let (sender, stale) = mpsc::channel();
        let ctx = ctx.clone();
        std::thread::spawn(move || {
            let mut check = Check::default();
            loop {
                match new_files.recv_timeout(interval) {
                    Ok(files) => check.files = files,
                    Err(RecvTimeoutError::Timeout) => {}
                    Err(RecvTimeoutError::Disconnected) => return,
                }
                for id in check.stale() {
                    if sender.send(id).is_err() {
                        return;
                    }
                    ctx.request_repaint();
                }
            }
        });
        Self { files, stale }
    }

    /// Watches these files in place of the earlier ones.
    fn watch(&self, files: Files) {
        // The thread ends only with this watcher.
        let _ = self.files.send(files);
    }

    /// The ids of the materials whose files have changed since the last call.
    fn stale(&self) -> Vec<u64> {
        self.stale.try_iter().collect()
    }
}

/// The watched files, and the changes that have been reported.
#[derive(Debug, Default)]
struct Check {
    files: Files,
    reported: HashMap<PathBuf, SystemTime>,
}

impl Check {
    /// The ids of the materials with a file that has changed since it was read and since it was last reported. A file
    /// that has vanished is not reported before it is there again.
    fn stale(&mut self) -> Vec<u64> {
        let mut stale = Vec::new();
        for (id, files) in &self.files {
            let mut is_stale = false;
            for (path, read) in files {
                let Some(now) = changed(path).filter(|now| Some(*now) != *read) else { continue };
                is_stale |= self.reported.insert(path.clone(), now) != Some(now);
            }
            stale.extend(is_stale.then_some(*id));
        }
        stale
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
        assert!(check.stale().is_empty());
        set_time(&path, 2000);
        assert_eq!(check.stale(), [7]);
        assert!(check.stale().is_empty(), "it is reported already");
        set_time(&path, 3000);
        assert_eq!(check.stale(), [7]);
        std::fs::remove_file(&path).unwrap();
        assert!(check.stale().is_empty(), "there is nothing to read");
        std::fs::write(&path, "b").unwrap();
        assert_eq!(check.stale(), [7], "it is there again");
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
        assert_eq!((repaints.load(Ordering::SeqCst), watcher.stale()), (0, vec![]));
        set_time(&path, 2000);
        let mut stale = Vec::new();
        for _ in 0..2000 {
            stale.extend(watcher.stale());
            if !stale.is_empty() && repaints.load(Ordering::SeqCst) > 0 {
                break;
            }
            std::thread::sleep(Duration::from_millis(5));
        }
        assert_eq!((repaints.load(Ordering::SeqCst), stale), (1, vec![7]));
    }
}
