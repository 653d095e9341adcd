//! Attributions of the losses of the predictions to their maps.

use std::time::{Duration, Instant};

use svbrdf_core::error::Error;
use svbrdf_core::loss::Request;
use svbrdf_core::why::{Attribution, attribute};

use crate::viewer::jobs::why::pair::{ComparedPair, PairKey};
use crate::viewer::jobs::work::job::Job;
use crate::viewer::jobs::work::latest::Latest;
use crate::viewer::jobs::work::waker::Waker;

/// Half of the 95% interval of the loss, as a share of the loss.
pub const ATTRIBUTION_TARGET: f64 = 0.01;

/// What an attribution depends on.
#[derive(Clone, Copy, Debug, PartialEq)]
struct AttributionKey {
    pair: PairKey,
    seed: u64,
}

/// An attribution, and the time that it took.
#[derive(Clone, Debug)]
pub struct Attributed {
    pub attribution: Attribution,
    pub elapsed: Duration,
}

/// The attributions of the predictions, computed one by one.
#[derive(Debug, Default)]
pub struct AttributionJob {
    latest: Latest<AttributionKey, Attributed>,
    /// Those of present predictions that are there.
    done: Vec<(AttributionKey, Attributed)>,
}

impl AttributionJob {
    /// Takes over a result, and computes the next one that is missing: of the `chosen` pair first. Where they are not
    /// `displayed`, those that are there stay.
    pub fn follow(
        &mut self,
        waker: &Waker,
        displayed: bool,
        pairs: &[ComparedPair],
        chosen: usize,
        seed: u64,
    ) -> Option<Error> {
        if !displayed {
            self.latest.pause();
            return None;
        }
        self.done.retain(|(key, _)| key.seed == seed && pairs.iter().any(|pair| pair.key == key.pair));
        let missing = |pair: &&ComparedPair| self.get(pair, seed).is_none();
        let pair = pairs.get(chosen).into_iter().chain(pairs).find(missing)?;
        let wanted = AttributionKey { pair: pair.key, seed };
        self.latest.drop_other(&wanted);
        let error = self.latest.follow(Some(wanted), |_| {
            let pair = pair.clone();
            Job::start(waker, move |progress| {
                let (start, request) =
                    (Instant::now(), Request::Accuracy { target: ATTRIBUTION_TARGET, seed });
                let (ground_truth, prediction) = (pair.ground_truth(), pair.prediction());
                let attribution = attribute(ground_truth, prediction, &pair.convention, &request, progress)?;
                Ok(Attributed { attribution, elapsed: start.elapsed() })
            })
        });
        if let Some((key, attributed)) = self.latest.get()
            && *key == wanted
        {
            self.done.push((wanted, attributed.clone()));
            // For the next one that is missing.
            waker.wake();
        }
        error
    }

    /// The attribution of this pair.
    pub fn get(&self, pair: &ComparedPair, seed: u64) -> Option<&Attributed> {
        let wanted = AttributionKey { pair: pair.key, seed };
        self.done.iter().find(|(key, _)| *key == wanted).map(|(_, attributed)| attributed)
    }

    /// The share of the work on a pair that is done and its time, while it goes on.
    pub fn busy(&self) -> Option<(f32, Duration)> {
        self.latest.running().map(|job| (job.fraction(), job.elapsed()))
    }
}
