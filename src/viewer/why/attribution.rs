//! How much of the loss of the chosen prediction comes from each map, computed on a worker.

use std::time::{Duration, Instant};

use eframe::egui;

use super::pair::{ComparedPair, PairKey};
use crate::error::Error;
use crate::loss::Request;
use crate::viewer::latest::Latest;
use crate::viewer::worker::Task;
use crate::why::{Attribution, attribute};

/// Half of the 95% interval of the loss, as a share of the loss.
pub(crate) const ATTRIBUTION_TARGET: f64 = 0.01;

/// What an attribution depends on.
#[derive(Clone, Copy, Debug, PartialEq)]
struct AttributionKey {
    pair: PairKey,
    seed: u64,
}

/// An attribution, and the time that it took.
#[derive(Clone, Debug)]
pub(crate) struct Attributed {
    pub attribution: Attribution,
    pub elapsed: Duration,
}

/// The attribution of the chosen prediction.
#[derive(Debug, Default)]
pub(crate) struct AttributionRun(Latest<AttributionKey, Attributed>);

impl AttributionRun {
    /// Takes over a result, and computes what is wanted now; where nothing is `shown`, the latest result is kept.
    pub(crate) fn follow(
        &mut self,
        ctx: &egui::Context,
        shown: bool,
        pair: Option<&ComparedPair>,
        seed: u64,
    ) -> Option<Error> {
        let Some(pair) = pair.filter(|_| shown) else {
            self.0.rest();
            return None;
        };
        let wanted = AttributionKey { pair: pair.key, seed };
        self.0.drop_other(&wanted);
        self.0.follow(ctx, Some(wanted), |_| {
            let pair = pair.clone();
            Task::start(ctx, move |progress| {
                let (start, request) =
                    (Instant::now(), Request::Accuracy { target: ATTRIBUTION_TARGET, seed });
                let (ground_truth, prediction) = (pair.ground_truth(), pair.prediction());
                let attribution = attribute(ground_truth, prediction, &pair.convention, &request, progress)?;
                Ok(Attributed { attribution, elapsed: start.elapsed() })
            })
        })
    }

    /// The attribution of this pair.
    pub(crate) fn get(&self, pair: &ComparedPair, seed: u64) -> Option<&Attributed> {
        let (of, attributed) = self.0.get()?;
        (*of == AttributionKey { pair: pair.key, seed }).then_some(attributed)
    }

    /// The share of the work that is done and its time, while it goes on.
    pub(crate) fn busy(&self) -> Option<(f32, Duration)> {
        self.0.running().map(|task| (task.fraction(), task.elapsed()))
    }
}
