//! The search for the worst scene of the chosen prediction, on a worker.

use std::time::Duration;

use eframe::egui;

use super::pair::{ComparedPair, PairKey};
use crate::error::Error;
use crate::viewer::worker::Task;
use crate::why::{Worst, worst};

/// The search that goes on, and the worst scene that was found.
#[derive(Debug, Default)]
pub(crate) struct SearchRun {
    running: Option<(PairKey, Task<Worst>)>,
    found: Option<(PairKey, Worst)>,
}

impl SearchRun {
    /// Starts a search; `seed` names the scenes that it starts from.
    pub(crate) fn start(&mut self, ctx: &egui::Context, pair: &ComparedPair, seed: u64) {
        let (key, pair) = (pair.key, pair.clone());
        let search = move |progress: &_| {
            worst(pair.ground_truth(), pair.prediction(), &pair.convention, seed, progress)
        };
        self.running = Some((key, Task::start(ctx, search)));
    }

    pub(crate) fn cancel(&mut self) {
        self.running = None;
    }

    /// Takes over the result, once. A search of another pair than the present one is cancelled.
    pub(crate) fn poll(
        &mut self,
        ctx: &egui::Context,
        pair: Option<&ComparedPair>,
    ) -> Option<Result<Worst, Error>> {
        let (key, task) = self.running.as_ref()?;
        if pair.is_none_or(|pair| pair.key != *key) {
            self.cancel();
            return None;
        }
        let (key, result) = (*key, task.poll(ctx)?);
        self.running = None;
        if let Ok(worst) = &result {
            self.found = Some((key, worst.clone()));
        }
        Some(result)
    }

    /// The worst scene that was found of this pair.
    pub(crate) fn found(&self, pair: &ComparedPair) -> Option<&Worst> {
        self.found.as_ref().filter(|(key, _)| *key == pair.key).map(|(_, worst)| worst)
    }

    /// The share of the search that is done and its time, while it goes on.
    pub(crate) fn busy(&self) -> Option<(f32, Duration)> {
        self.running.as_ref().map(|(_, task)| (task.fraction(), task.elapsed()))
    }
}
