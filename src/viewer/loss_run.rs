//! The loss in the window: computed on a worker, for the materials and parameters of now.

use std::sync::Arc;
use std::time::Duration;

use eframe::egui;

use super::slots::{Loaded, Slots};
use super::worker::Job;
use crate::loss::{self, Loss, LossParams};
use crate::material::Material;

/// What a loss depends on: the ids of the materials, the ground truth first, and the parameters.
#[derive(Clone, Debug, PartialEq)]
pub struct Key {
    ids: Vec<u64>,
    params: LossParams,
}

/// A loss that is being computed: the losses and the time they took.
type LossJob = Job<(Vec<Loss>, Duration)>;

/// A loss that was computed.
#[derive(Clone, Debug)]
pub struct Done {
    key: Key,
    pub losses: Vec<Loss>,
    pub params: LossParams,
    pub elapsed: Duration,
}

/// The loss that is being computed and the one that was.
#[derive(Debug, Default)]
pub struct LossRun {
    running: Option<(Key, LossJob)>,
    done: Option<Done>,
    /// The key that a person cancelled or that failed: not tried again by itself.
    given_up: Option<Key>,
}

impl LossRun {
    /// The latest result, and whether it still holds for `params` and `slots`.
    pub fn done(&self, slots: &Slots, params: &LossParams) -> Option<(&Done, bool)> {
        self.done.as_ref().map(|done| (done, done.key == key(slots, params)))
    }

    /// The running job, for its progress.
    pub fn job(&self) -> Option<&LossJob> {
        self.running.as_ref().map(|(_, job)| job)
    }

    /// Takes over a finished loss; returns its error, for the user.
    pub fn poll(&mut self, ctx: &egui::Context) -> Option<String> {
        let result = self.running.as_ref().and_then(|(_, job)| job.poll(ctx))?;
        let (key, _) = self.running.take()?;
        match result {
            Ok((losses, elapsed)) => {
                self.done = Some(Done { params: key.params.clone(), key, losses, elapsed });
                None
            }
            Err(error) => {
                self.given_up = Some(key);
                Some(error.to_string())
            }
        }
    }

    /// Starts the loss unless the one that is asked for runs, is done or was given up.
    pub fn keep_up(&mut self, ctx: &egui::Context, slots: &Slots, params: &LossParams) {
        let key = key(slots, params);
        let known = [
            self.running.as_ref().map(|(k, _)| k),
            self.done.as_ref().map(|d| &d.key),
            self.given_up.as_ref(),
        ];
        if !known.contains(&Some(&key)) {
            self.start(ctx, slots, params);
        }
    }

    /// Starts the loss of the predictions in `slots`; a running one is given up for it.
    pub fn start(&mut self, ctx: &egui::Context, slots: &Slots, params: &LossParams) {
        self.running = None;
        self.given_up = None;
        if slots.predictions().is_empty() {
            self.done = None;
            return;
        }
        let key = key(slots, params);
        let materials: Vec<Arc<Loaded>> = slots.slots.iter().map(|s| s.loaded.clone()).collect();
        let params = params.clone();
        let job = Job::start(ctx, move |progress| {
            let scenes = params.scenes()?;
            let materials: Vec<&Material<f32>> = materials.iter().map(|l| &l.material).collect();
            let start = std::time::Instant::now();
            let (ground_truth, predictions) = (materials[0], &materials[1..]);
            let losses = loss::losses_f32(ground_truth, predictions, &scenes, &params.convention, progress)?;
            Ok((losses, start.elapsed()))
        });
        self.running = Some((key, job));
    }

    /// Stops the running loss and does not start it again by itself.
    pub fn cancel(&mut self) {
        if let Some((key, job)) = self.running.take() {
            job.cancel();
            self.given_up = Some(key);
        }
    }
}

fn key(slots: &Slots, params: &LossParams) -> Key {
    Key { ids: slots.slots.iter().map(|s| s.id).collect(), params: params.clone() }
}
