//! The study in the window: measured on a worker, updated as it grows.

use std::sync::mpsc::{self, Receiver};

use eframe::egui;

use super::slots::Slots;
use super::worker::Task;
use crate::error::Error;
use crate::model::convention::Convention;
use crate::study::{self, Pair, Study};

/// What a study depends on: the ids of ground truth and prediction, and the convention.
type StudyKey = ([u64; 2], &'static str);

/// The running study, and the results of it or of an earlier one.
#[derive(Debug, Default)]
pub(super) struct StudyRun {
    running: Option<RunningStudy>,
    measured: Option<Measured>,
}

/// The measurements, complete or so far.
#[derive(Debug)]
struct Measured {
    key: StudyKey,
    study: Study,
    complete: bool,
}

#[derive(Debug)]
struct RunningStudy {
    key: StudyKey,
    task: Task<Study>,
    growing: Receiver<Study>,
}

impl StudyRun {
    /// What has been measured, and whether it is of the current materials.
    pub(super) fn measured(
        &self,
        slots: &Slots,
        prediction: usize,
        convention: &Convention,
    ) -> Option<(&Study, bool)> {
        let now = key(slots, prediction, convention);
        self.measured.as_ref().map(|measured| (&measured.study, Some(measured.key) == now))
    }

    /// The running study, for its progress.
    pub(super) fn task(&self) -> Option<&Task<Study>> {
        self.running.as_ref().map(|running| &running.task)
    }

    /// Starts to measure `prediction` against the ground truth, unless that is done or running.
    pub(super) fn keep_up(
        &mut self,
        ctx: &egui::Context,
        slots: &Slots,
        prediction: usize,
        convention: &Convention,
    ) {
        let now = key(slots, prediction, convention);
        let known = [
            self.running.as_ref().map(|r| r.key),
            self.measured.as_ref().filter(|measured| measured.complete).map(|measured| measured.key),
        ];
        if !known.contains(&now) {
            self.start(ctx, slots, prediction, convention);
        }
    }

    /// Starts to measure; a running study is cancelled.
    pub(super) fn start(
        &mut self,
        ctx: &egui::Context,
        slots: &Slots,
        prediction: usize,
        convention: &Convention,
    ) {
        self.running = None;
        let Some(key) = key(slots, prediction, convention) else { return };
        let [ground_truth, prediction] = [0, prediction + 1].map(|slot| slots.slots[slot].loaded.clone());
        let convention = *convention;
        let (sender, growing) = mpsc::channel();
        let seen = ctx.clone();
        let task = Task::start(ctx, move |progress| {
            // The window computes its loss on the CPU.
            let (ground_truth, prediction) = (&ground_truth.material, &prediction.material);
            let pair = Pair { ground_truth, prediction, convention, gpu: None };
            study::run(&pair, progress, |study| {
                // Where the window has dropped this task, the result is not wanted.
                let _ = sender.send(study.clone());
                seen.request_repaint();
            })
        });
        self.running = Some(RunningStudy { key, task, growing });
    }

    /// Takes over what has been measured since the last call; returns the error of a failed study.
    pub(super) fn poll(&mut self, ctx: &egui::Context) -> Option<Error> {
        let running = self.running.as_ref()?;
        let latest = running.growing.try_iter().last();
        let result = running.task.poll(ctx);
        let key = running.key;
        if let Some(study) = latest {
            self.measured = Some(Measured { key, study, complete: false });
        }
        let result = result?;
        self.running = None;
        match result {
            Ok(study) => {
                self.measured = Some(Measured { key, study, complete: true });
                None
            }
            Err(error) => Some(error),
        }
    }

    /// Stops measuring; what has been measured stays.
    pub(super) fn cancel(&mut self) {
        self.running = None;
    }
}

fn key(slots: &Slots, prediction: usize, convention: &Convention) -> Option<StudyKey> {
    let ids = [slots.ground_truth()?.id, slots.predictions().get(prediction)?.id];
    Some((ids, convention.name))
}
