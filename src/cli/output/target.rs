//! Target errors that are not reached.

use svbrdf::error::Error;
use svbrdf::loss::{Estimate, Outcome};

use super::error::CommandError;
use super::exit;

/// The error of a loss over `scenes` scenes whose 95% interval reaches further from it than `target`, a share of it.
pub fn missed(target: f64, prediction: &str, loss: &Estimate, scenes: usize) -> Option<Error> {
    let reached = loss.relative_error95();
    let prediction = prediction.to_owned();
    (reached > target).then_some(Error::Inaccurate { prediction, reached, target, scenes })
}

/// As [`missed`], of the loss of an outcome with the widest interval relative to it.
pub fn missed_by_any(target: f64, outcome: &Outcome) -> Option<Error> {
    let error = |estimate: &Estimate| estimate.relative_error95();
    let least = outcome.losses.iter().max_by(|a, b| error(&a.estimate).total_cmp(&error(&b.estimate)))?;
    missed(target, &least.prediction, &least.estimate, outcome.scenes.len())
}

/// Prints a warning for each of `missed`, once the results are printed.
///
/// # Errors
/// The first of them where the command line is `strict`.
pub fn warn_of(missed: impl IntoIterator<Item = Error>, strict: bool) -> Result<(), CommandError> {
    let mut missed = missed.into_iter();
    let failure = if strict { missed.next() } else { None };
    for warning in missed {
        exit::tell(&format!("warning: {warning}"));
    }
    failure.map_or(Ok(()), |failure| Err(failure.into()))
}
