//! Search for the worst scene of the chosen prediction.

use std::time::Duration;

use svbrdf_evaluate::why::{TAIL, Worst, worst};

use crate::error::Error;
use crate::jobs::why::pair::{ComparedPair, PairKey};
use crate::jobs::work::job::Job;
use crate::jobs::work::waker::Waker;

/// The search that goes on, and the worst scene that was found.
#[derive(Debug, Default)]
pub struct SearchJob {
    running: Option<(PairKey, Job<Worst>)>,
    found: Option<(PairKey, Worst)>,
}

impl SearchJob {
    /// Starts a search; `seed` names the scenes that it starts from.
    pub fn start(&mut self, waker: &Waker, pair: &ComparedPair, seed: u64) {
        let (key, pair) = (pair.key, pair.clone());
        let search = move |progress: &_| {
            Ok(worst(pair.ground_truth(), pair.prediction(), &pair.convention, seed, TAIL, progress)?)
        };
        self.running = Some((key, Job::start(waker, search)));
    }

    pub fn cancel(&mut self) {
        self.running = None;
    }

    /// Takes over the result, once. A search of another pair than the present one is cancelled.
    pub fn poll(&mut self, pair: Option<&ComparedPair>) -> Option<Result<Worst, Error>> {
        let (key, job) = self.running.as_ref()?;
        if pair.is_none_or(|pair| pair.key != *key) {
            self.cancel();
            return None;
        }
        let (key, result) = (*key, job.poll()?);
        self.running = None;
        if let Ok(worst) = &result {
            self.found = Some((key, worst.clone()));
        }
        Some(result)
    }

    /// The worst scene that was found of this pair.
    pub fn found(&self, pair: &ComparedPair) -> Option<&Worst> {
        self.found.as_ref().filter(|(key, _)| *key == pair.key).map(|(_, worst)| worst)
    }

    /// The share of the search that is done and its time, while it goes on.
    pub fn busy(&self) -> Option<(f32, Duration)> {
        self.running.as_ref().map(|(_, job)| (job.fraction(), job.elapsed()))
    }
}
