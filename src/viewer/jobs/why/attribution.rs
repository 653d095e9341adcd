//! Attribution of the loss of the chosen prediction to its maps.

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

/// The attribution of the chosen prediction.
#[derive(Debug, Default)]
pub struct AttributionJob(Latest<AttributionKey, Attributed>);

impl AttributionJob {
    /// Takes over a result, and computes what is wanted now; where it is not `displayed`, the latest result stays.
    pub fn follow(
        &mut self,
        waker: &Waker,
        displayed: bool,
        pair: Option<&ComparedPair>,
        seed: u64,
    ) -> Option<Error> {
        let Some(pair) = pair.filter(|_| displayed) else {
            self.0.pause();
            return None;
        };
        let wanted = AttributionKey { pair: pair.key, seed };
        self.0.drop_other(&wanted);
        self.0.follow(Some(wanted), |_| {
            let pair = pair.clone();
            Job::start(waker, move |progress| {
                let (start, request) =
                    (Instant::now(), Request::Accuracy { target: ATTRIBUTION_TARGET, seed });
                let (ground_truth, prediction) = (pair.ground_truth(), pair.prediction());
                let attribution = attribute(ground_truth, prediction, &pair.convention, &request, progress)?;
                Ok(Attributed { attribution, elapsed: start.elapsed() })
            })
        })
    }

    /// The attribution of this pair.
    pub fn get(&self, pair: &ComparedPair, seed: u64) -> Option<&Attributed> {
        let (of, attributed) = self.0.get()?;
        (*of == AttributionKey { pair: pair.key, seed }).then_some(attributed)
    }

    /// The share of the work that is done and its time, while it goes on.
    pub fn busy(&self) -> Option<(f32, Duration)> {
        self.0.running().map(|job| (job.fraction(), job.elapsed()))
    }
}
