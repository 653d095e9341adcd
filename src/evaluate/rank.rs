//! Many predictions of one ground truth, best first, with what the data can separate.

use serde::Serialize;

use svbrdf_core::loss::{Estimate, Loss, MOST_SCENES, Outcome};
use svbrdf_core::statistics::order;

/// Most scenes for a ranking of `predictions`, which are compared in the same ones: half as many renderings as a loss may take, and
/// at least 24,576 scenes.
pub fn most_scenes(predictions: usize) -> usize {
    (MOST_SCENES / (1 + predictions)).max(24_576)
}

/// A prediction in a ranking.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct RankedPrediction {
    /// The index of the prediction in the order of the question.
    pub index: usize,
    pub prediction: String,
    pub loss: Estimate,
    /// The loss - the loss of the best prediction, over the same scenes; `None` for the best.
    pub to_best: Option<Estimate>,
    /// From 1. Predictions of one group are not separated from its first at 95% confidence.
    pub group: usize,
    /// Whether the loss is above the floor; `None` without a floor.
    pub resolvable: Option<bool>,
    /// Whether the difference to the best is above the floor.
    pub to_best_resolvable: Option<bool>,
}

/// The predictions of an outcome, smallest loss first. Equal losses keep their order. A group begins with the first prediction whose
/// difference to the first of the group before has a 95% interval without 0.
pub fn places(outcome: &Outcome) -> Vec<RankedPrediction> {
    let order = order(&outcome.losses.iter().map(|loss| loss.estimate.mean).collect::<Vec<_>>());
    let Some(&best) = order.first() else { return Vec::new() };
    let (mut first, mut group) = (best, 1);
    let place = |&index: &usize| {
        if index != first && separated(&outcome.difference(index, first)) {
            (first, group) = (index, group + 1);
        }
        let to_best = (index != best).then(|| outcome.difference(index, best));
        let Loss { prediction, estimate: loss, .. } = &outcome.losses[index];
        RankedPrediction {
            index,
            prediction: prediction.clone(),
            loss: *loss,
            to_best,
            group,
            resolvable: None,
            to_best_resolvable: None,
        }
    };
    order.iter().map(place).collect()
}

/// Whether a difference is larger than 0 at 95% confidence.
fn separated(difference: &Estimate) -> bool {
    difference.interval95.is_some_and(|[low, _]| low > 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn many_predictions_share_the_work_of_one_down_to_a_least_number_of_scenes() {
        assert_eq!([1, 3, 31, 32, 1000].map(most_scenes), [393_216, 196_608, 24_576, 24_576, 24_576]);
    }
}
