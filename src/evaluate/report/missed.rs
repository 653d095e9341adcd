//! Requested accuracies that are not reached.

use svbrdf_core::loss::Estimate;
use svbrdf_core::text::percent;

/// A sentence about a loss over `scenes` scenes whose 95% interval reaches further from it than `target`, a share of it.
pub fn missed(target: f64, prediction: &str, loss: &Estimate, scenes: usize) -> Option<String> {
    let reached = loss.relative_error95();
    (reached > target).then(|| {
        format!(
            "{prediction} is known to +-{}, not to the target of +-{}: {scenes} scenes, the limit, are not enough; go by the \
             interval, or set a larger target",
            percent(reached),
            percent(target)
        )
    })
}

/// As [`missed`], of that of the losses, each beside its prediction, which is known least.
pub fn missed_by_any<'a>(
    target: f64,
    losses: impl Iterator<Item = (&'a str, Estimate)>,
    scenes: usize,
) -> Option<String> {
    let error = |(_, loss): &(&str, Estimate)| loss.relative_error95();
    let (prediction, loss) = losses.max_by(|a, b| error(a).total_cmp(&error(b)))?;
    missed(target, prediction, &loss, scenes)
}
