//! Attributions of the losses of the predictions to their maps.

use std::time::{Duration, Instant};

use svbrdf_core::loss::Request;
use svbrdf_core::progress::Progress;
use svbrdf_evaluate::why::{Attribution, attribute};

use crate::error::Error;
use crate::jobs::why::one_by_one::OneByOne;
use crate::jobs::why::pair::ComparedPair;

/// Half of the 95% interval of the loss, as a share of the loss.
pub const ATTRIBUTION_TARGET: f64 = 0.01;

/// An attribution, and the time that it took.
#[derive(Clone, Debug)]
pub struct Attributed {
    pub attribution: Attribution,
    pub elapsed: Duration,
}

/// The attributions of the predictions.
pub type AttributionJob = OneByOne<Attributed>;

/// The attribution of the loss of a pair.
///
/// # Errors
/// [`Cancelled`](Error::is_cancelled).
pub fn attributed(pair: &ComparedPair, seed: u64, progress: &Progress) -> Result<Attributed, Error> {
    let (start, request) = (Instant::now(), Request::Accuracy { target: ATTRIBUTION_TARGET, seed });
    let (ground_truth, prediction) = (pair.ground_truth(), pair.prediction());
    let attribution = attribute(ground_truth, prediction, &pair.convention, &request, progress)?;
    Ok(Attributed { attribution, elapsed: start.elapsed() })
}
