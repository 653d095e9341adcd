//! Requested accuracies that are not reached.

use svbrdf_core::loss::Estimate;

use crate::error::Error;

/// The error of a loss over `scenes` scenes whose 95% interval reaches further from it than `target`, a share of it.
pub fn missed(target: f64, prediction: &str, loss: &Estimate, scenes: usize) -> Option<Error> {
    let reached = loss.relative_error95();
    let prediction = prediction.to_owned();
    (reached > target).then_some(Error::Inaccurate { prediction, reached, target, scenes })
}

/// As [`missed`], of that of the losses, each beside its prediction, which is known least.
pub fn missed_by_any<'a>(
    target: f64,
    losses: impl Iterator<Item = (&'a str, Estimate)>,
    scenes: usize,
) -> Option<Error> {
    let error = |(_, loss): &(&str, Estimate)| loss.relative_error95();
    let (prediction, loss) = losses.max_by(|a, b| error(a).total_cmp(&error(b)))?;
    missed(target, prediction, &loss, scenes)
}
