//! Attribution of a loss to the maps: Shapley values.
//!
//! With v(S) the loss of the ground truth that takes the maps S from the prediction, v of no map is 0 and v of all four is
//! the loss. What a map adds to v depends on which maps are wrong already: a wrong roughness hardly matters under a wrong
//! normal. The Shapley value of a map is the mean of what it adds over all orders in which the four maps can become wrong
//! (Shapley 1953). The four values add up to the loss, and a map that changes nothing has the value 0.
//!
//! All 16 mixtures are rendered in the same scenes on the same texels, so that the values add up to rounding in each scene, and
//! variance that the mixtures have in common cancels.

use serde::Serialize;

use svbrdf_core::error::Error;
use svbrdf_core::loss::{self, Comparison, Compute, Estimate, Request, Sampling};
use svbrdf_core::material::{Map, Material};
use svbrdf_core::model::convention::Convention;
use svbrdf_core::model::sampler::Sampler;
use svbrdf_core::model::scene::Scene;
use svbrdf_core::progress::Progress;

/// Mixtures are rendered together as far as their maps fit into this much memory.
const MOST_BYTES: usize = 1 << 30;
/// Number of sets of maps.
const SETS: usize = 16;
/// Most scenes of an attribution, and of the mean beside a worst scene: an attribution renders 16 mixtures in each, and should take no
/// longer than a loss.
pub const MOST_SCENES: usize = loss::MOST_SCENES / SETS;

/// The loss of a prediction, and what each map adds to it.
#[derive(Clone, Debug, PartialEq)]
pub struct Attribution {
    /// The name of the prediction.
    pub prediction: String,
    /// The sampling of the scenes; `None` where they were listed.
    pub sampling: Option<Sampling>,
    /// The scenes.
    pub scenes: Vec<Scene>,
    /// The loss over the scenes: the sum of the Shapley values.
    pub loss: Estimate,
    /// In the order of [`Map::ALL`].
    pub maps: [MapShare; 4],
}

/// What a map adds to a loss. Estimates have the unit of the loss; their errors are due to the sampling of scenes and texels.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct MapShare {
    pub map: Map,
    /// The Shapley value.
    pub shapley: Estimate,
    /// The loss where only this map is wrong: the others are the maps of the ground truth.
    pub only_wrong: Estimate,
    /// The loss where only this map is right: the others are the maps of the prediction.
    pub only_right: Estimate,
}

impl Attribution {
    /// The share of `map`.
    pub fn of(&self, map: Map) -> &MapShare {
        &self.maps[index(map)]
    }

    /// What shares below 0% mean, where there are any: a sentence for people.
    pub fn note(&self) -> Option<String> {
        let is_below = |e: &Estimate| e.interval95.map_or(e.mean, |[_, high]| high) < 0.0;
        let below = self.maps.iter().filter(|share| is_below(&share.shapley));
        let names: Vec<_> = below.map(|share| share.map.name()).collect();
        let verb = if names.len() == 1 { "cancels" } else { "cancel" };
        let names = (!names.is_empty()).then(|| names.join(" and "))?;
        Some(format!("A negative share: the wrong {names} partly {verb} the errors of other maps."))
    }
}

/// How much of the loss of `prediction` comes from each of its maps, over the scenes of `request`.
///
/// Intervals come from the scenes alone, so `request` should sample many, as [`Request::Accuracy`] does. An accuracy or a time
/// samples at most [`MOST_SCENES`]; the interval of the loss tells whether an accuracy is reached.
///
/// # Errors
/// [`Error::SizesDiffer`], and those of [`Comparison::run`].
pub fn attribute<T: Compute>(
    ground_truth: &Material<T>,
    prediction: &Material<T>,
    convention: &Convention,
    request: &Request,
    progress: &Progress,
) -> Result<Attribution, Error> {
    attribute_in(&Comparison::new(ground_truth, &[prediction], *convention)?, prediction, request, progress)
}

/// The same of a prediction of a comparison, on the texels that it compares.
///
/// # Errors
/// As [`attribute`].
pub fn attribute_in<T: Compute>(
    comparison: &Comparison<'_, T>,
    prediction: &Material<T>,
    request: &Request,
    progress: &Progress,
) -> Result<Attribution, Error> {
    let ground_truth = comparison.ground_truth();
    let alone = comparison.with_predictions(&[prediction])?.without_pilot().at_most(MOST_SCENES);
    let mut outcome = alone.run(request, progress)?;
    let mut values = vec![Vec::new(); SETS];
    values[0] = vec![0.0; outcome.scenes.len()];
    let loss = outcome.losses.remove(0);
    values[SETS - 1] = loss.per_scene;
    let again = match outcome.sampling {
        Some(sampling) => Request::Scenes(sampling),
        None => Request::Listed(outcome.scenes.clone()),
    };
    let sets: Vec<usize> = (1..SETS - 1).collect();
    for sets in sets.chunks(most_mixtures(ground_truth)) {
        let mixed = mixtures(ground_truth, prediction, sets)?;
        // The prediction decides which texels are sampled, and is compared again for that.
        let compared: Vec<_> = mixed.iter().chain([prediction]).collect();
        let losses = alone.with_predictions(&compared)?.run(&again, progress)?.losses;
        for (&set, loss) in sets.iter().zip(losses) {
            values[set] = loss.per_scene;
        }
    }
    let sampler = outcome.sampling.map_or(Sampler::Random, |sampling| sampling.sampler);
    let estimate =
        |values: &[f64]| Estimate::of_difference(sampler, &outcome.scenes, values, &vec![0.0; values.len()]);
    let maps = Map::ALL.map(|map| MapShare {
        map,
        shapley: estimate(&shapley(&values, map)),
        only_wrong: estimate(&values[bit(map)]),
        only_right: estimate(&values[SETS - 1 - bit(map)]),
    });
    let prediction = loss.prediction;
    Ok(Attribution {
        prediction,
        sampling: outcome.sampling,
        scenes: outcome.scenes,
        loss: loss.estimate,
        maps,
    })
}

/// The number of mixtures that are in memory at a time.
fn most_mixtures<T>(material: &Material<T>) -> usize
where
    T: Compute,
{
    let bytes = 10 * size_of::<T>() * material.width() * material.height();
    (MOST_BYTES / bytes).clamp(1, SETS - 2)
}

/// For each of `sets` the ground truth with those maps of the prediction.
fn mixtures<T: Compute>(
    ground_truth: &Material<T>,
    prediction: &Material<T>,
    sets: &[usize],
) -> Result<Vec<Material<T>>, Error> {
    let mixture = |set: &usize| ground_truth.with_maps_of(prediction, |map| set & bit(map) != 0);
    sets.iter().map(mixture).collect()
}

/// The Shapley value of `map` in each scene; `values` are the losses of each set of maps.
fn shapley(values: &[Vec<f64>], map: Map) -> Vec<f64> {
    /// |S|! (3 - |S|)! / 4!: the share of the orders in which the maps S come before this one.
    const WEIGHTS: [f64; 4] = [1.0 / 4.0, 1.0 / 12.0, 1.0 / 12.0, 1.0 / 4.0];
    let without = (0..SETS).filter(|set| set & bit(map) == 0);
    let mut sum = vec![0.0; values[0].len()];
    for set in without {
        let weight = WEIGHTS[set.count_ones() as usize];
        for ((sum, after), before) in sum.iter_mut().zip(&values[set | bit(map)]).zip(&values[set]) {
            *sum += weight * (after - before);
        }
    }
    sum
}

fn index(map: Map) -> usize {
    Map::ALL.iter().position(|&other| other == map).unwrap_or(0)
}

/// Sets of maps are numbers with a bit for each map.
fn bit(map: Map) -> usize {
    1 << index(map)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn attribution(shares: [(f64, [f64; 2]); 4]) -> Attribution {
        let estimate = |(mean, ends)| Estimate { mean, standard_error: Some(0.1), interval95: Some(ends) };
        let loss = estimate((1.0, [0.9, 1.1]));
        let share =
            |map| MapShare { map, shapley: estimate(shares[index(map)]), only_wrong: loss, only_right: loss };
        let maps = Map::ALL.map(share);
        Attribution { prediction: "p".to_owned(), sampling: None, scenes: Vec::new(), loss, maps }
    }

    #[test]
    fn shares_that_are_surely_below_0_are_explained() {
        let [below, at, above] = [(-0.2, [-0.3, -0.1]), (-0.01, [-0.03, 0.01]), (1.2, [1.1, 1.3])];
        assert_eq!(attribution([above, at, at, at]).note(), None);
        let name = |i: usize| Map::ALL[i].name();
        let one = attribution([above, below, at, at]).note().unwrap();
        assert!(one.contains(&format!("the wrong {} partly cancels the errors", name(1))), "{one}");
        let two = attribution([above, at, below, below]).note().unwrap();
        assert!(
            two.contains(&format!("the wrong {} and {} partly cancel the errors", name(2), name(3))),
            "{two}"
        );
    }

    /// The game of a glove market: only a left glove (maps 0, 1) with a right one (2, 3) is worth something.
    #[test]
    fn shapley_values_of_a_known_game() {
        let value = |set: usize| ((set & 3).count_ones().min((set >> 2).count_ones())) as f64;
        let values: Vec<Vec<f64>> =
            (0..SETS).map(|set| vec![value(set), if set & 1 == 1 { 3.0 } else { 0.0 }]).collect();
        let found = Map::ALL.map(|map| shapley(&values, map));
        for (i, shares) in found.iter().enumerate() {
            assert!((shares[0] - 0.5).abs() < 1e-15, "{found:?}");
            assert!((shares[1] - if i == 0 { 3.0 } else { 0.0 }).abs() < 1e-15, "{found:?}");
        }
    }
}
