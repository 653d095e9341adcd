//! Files that change on disk, detected on a worker.

use std::path::PathBuf;
use std::time::{Duration, Instant, SystemTime};

use eframe::egui;

use super::loaded::changed;
use super::slots::Slots;
use super::worker::Task;

/// Time between two checks.
const INTERVAL: Duration = Duration::from_secs(1);

/// Checks the files of all materials once a second.
#[derive(Debug, Default)]
pub struct Watch {
    check: Option<Task<Vec<u64>>>,
    last: Option<Instant>,
}

impl Watch {
    /// The indices of the materials whose files have changed since they were read.
    pub fn poll(&mut self, ctx: &egui::Context, slots: &Slots) -> Vec<usize> {
        let changed = self.check.as_ref().and_then(|job| job.poll(ctx));
        if changed.is_some() {
            self.check = None;
        }
        let due = self.last.is_none_or(|last| last.elapsed() >= INTERVAL);
        if due && self.check.is_none() && slots.openings.is_empty() {
            self.last = Some(Instant::now());
            self.check = Some(check(ctx, slots));
        }
        ctx.request_repaint_after(INTERVAL);
        let ids = changed.and_then(Result::ok).unwrap_or_default();
        let index = |id| slots.slots.iter().position(|s| s.id == id);
        ids.into_iter().filter_map(index).collect()
    }
}

fn check(ctx: &egui::Context, slots: &Slots) -> Task<Vec<u64>> {
    type Files = Vec<(PathBuf, Option<SystemTime>)>;
    let all: Vec<(u64, Files)> = slots.slots.iter().map(|s| (s.id, s.loaded.files.clone())).collect();
    Task::start(ctx, move |_| {
        let is_newer = |(path, read): &(PathBuf, Option<SystemTime>)| {
            let now = changed(path);
            now.is_some() && now != *read
        };
        let stale = all.iter().filter(|(_, files)| files.iter().any(is_newer));
        Ok(stale.map(|(id, _)| *id).collect())
    })
}
