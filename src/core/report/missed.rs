//! Requested accuracies that are not reached.

use crate::error::Error;
use crate::loss::{Estimate, Outcome};

/// The error of a loss over `scenes` scenes whose 95% interval reaches further from it than `target`, a share of it.
pub fn missed(target: f64, prediction: &str, loss: &Estimate, scenes: usize) -> Option<Error> {
    let reached = loss.relative_error95();
    let prediction = prediction.to_owned();
    (reached > target).then_some(Error::Inaccurate { prediction, reached, target, scenes })
}

/// As [`missed`], of the loss of an outcome that is known least.
pub(super) fn missed_by_any(target: f64, outcome: &Outcome) -> Option<Error> {
    let error = |estimate: &Estimate| estimate.relative_error95();
    let least = outcome.losses.iter().max_by(|a, b| error(&a.estimate).total_cmp(&error(&b.estimate)))?;
    missed(target, &least.prediction, &least.estimate, outcome.scenes.len())
}
