//! The study in the window: measured on a worker, shown as it grows.

use std::sync::mpsc::{self, Receiver};

use eframe::egui;

use super::slots::Slots;
use super::worker::Job;
use crate::model::convention::Convention;
use crate::study::{self, Pair, Study};

/// What a study holds for: the ids of the ground truth and of the prediction, and the convention.
type Key = ([u64; 2], &'static str);

/// The study that is being measured, and what is known of it or of an earlier one.
#[derive(Debug, Default)]
pub struct StudyRun {
    running: Option<Running>,
    shown: Option<Shown>,
}

/// What has been measured, all of it or a part.
#[derive(Debug)]
struct Shown {
    key: Key,
    study: Study,
    complete: bool,
}

#[derive(Debug)]
struct Running {
    key: Key,
    job: Job<Study>,
    growing: Receiver<Study>,
}

impl StudyRun {
    /// What has been measured, and whether it is about the materials of now.
    pub fn shown(&self, slots: &Slots, prediction: usize, convention: &Convention) -> Option<(&Study, bool)> {
        let now = key(slots, prediction, convention);
        self.shown.as_ref().map(|shown| (&shown.study, Some(shown.key) == now))
    }

    /// The running job, for its progress.
    pub fn job(&self) -> Option<&Job<Study>> {
        self.running.as_ref().map(|running| &running.job)
    }

    /// Starts to measure `prediction` against the ground truth, unless this has been done or is being done.
    pub fn keep_up(
        &mut self,
        ctx: &egui::Context,
        slots: &Slots,
        prediction: usize,
        convention: &Convention,
    ) {
        let now = key(slots, prediction, convention);
        let known = [
            self.running.as_ref().map(|r| r.key),
            self.shown.as_ref().filter(|shown| shown.complete).map(|shown| shown.key),
        ];
        if !known.contains(&now) {
            self.start(ctx, slots, prediction, convention);
        }
    }

    /// Starts to measure; a running study is given up for it.
    pub fn start(&mut self, ctx: &egui::Context, slots: &Slots, prediction: usize, convention: &Convention) {
        self.running = None;
        let Some(key) = key(slots, prediction, convention) else { return };
        let [ground_truth, prediction] = [0, prediction + 1].map(|slot| slots.slots[slot].loaded.clone());
        let convention = *convention;
        let (sender, growing) = mpsc::channel();
        let seen = ctx.clone();
        let job = Job::start(ctx, move |progress| {
            // The window's loss is computed on the CPU.
            let (ground_truth, prediction) = (&ground_truth.material, &prediction.material);
            let pair = Pair { ground_truth, prediction, convention, gpu: None };
            study::run(&pair, progress, |study| {
                // Nobody looks any more where the window has dropped this job.
                let _ = sender.send(study.clone());
                seen.request_repaint();
            })
        });
        self.running = Some(Running { key, job, growing });
    }

    /// Takes over what has been measured since the last call; returns the error of a failed study, for the user.
    pub fn poll(&mut self, ctx: &egui::Context) -> Option<String> {
        let running = self.running.as_ref()?;
        let latest = running.growing.try_iter().last();
        let result = running.job.poll(ctx);
        let key = running.key;
        if let Some(study) = latest {
            self.shown = Some(Shown { key, study, complete: false });
        }
        let result = result?;
        self.running = None;
        match result {
            Ok(study) => {
                self.shown = Some(Shown { key, study, complete: true });
                None
            }
            Err(problem) => Some(problem.to_string()),
        }
    }

    /// Stops measuring; what has been measured stays.
    pub fn cancel(&mut self) {
        self.running = None;
    }
}

fn key(slots: &Slots, prediction: usize, convention: &Convention) -> Option<Key> {
    let ids = [slots.ground_truth()?.id, slots.predictions().get(prediction)?.id];
    Some((ids, convention.name))
}
