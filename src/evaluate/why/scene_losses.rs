//! Scenes of a loss, worst first, and the distribution of their losses.

use svbrdf_core::error::Error;
use svbrdf_core::loss::{Comparison, Compute, Outcome, Sampling, Texels, losses_on_texels};
use svbrdf_core::model::scene::Scene;
use svbrdf_core::progress::Progress;
use svbrdf_core::statistics::sort_by_number;
use svbrdf_core::statistics::{median, quantile};

/// Scenes that [`worst_on_all_texels`] recomputes at a time.
const BATCH: usize = 64;
/// The scenes that it orders anew first, by this many texels of each.
const CLOSER: [usize; 2] = [1024, 1024];

/// A scene and its losses.
#[derive(Clone, Debug, PartialEq)]
pub struct RankedScene {
    /// Its number among the scenes of the loss, from 0.
    pub index: usize,
    pub scene: Scene,
    /// The loss of each prediction in this scene.
    pub losses: Vec<f64>,
}

impl RankedScene {
    fn total(&self) -> f64 {
        self.losses.iter().sum()
    }
}

/// The scenes of a loss, worst first: by the mean of the losses of all predictions. Equal ones keep their order.
pub fn worst_first(outcome: &Outcome) -> Vec<RankedScene> {
    let one = |(index, scene): (usize, &Scene)| {
        let losses = outcome.losses.iter().map(|loss| loss.per_scene[index]).collect();
        RankedScene { index, scene: *scene, losses }
    };
    sorted(outcome.scenes.iter().enumerate().map(one).collect())
}

/// The `count` worst scenes of `outcome`, worst first, with their losses on all texels.
///
/// Where the losses of `outcome` are of a random subset of the texels, a scene may lead by its subset. So the 1,024 that lead are
/// ordered by 1,024 texels of each, and all are recomputed on all texels, 64 at a time in this order, until 64 of them change
/// nothing in the list.
///
/// # Errors
/// Those of the backend.
pub fn worst_on_all_texels<T: Compute>(
    comparison: &Comparison<'_, T>,
    outcome: &Outcome,
    count: usize,
    progress: &Progress,
) -> Result<Vec<RankedScene>, Error> {
    let mut candidates = worst_first(outcome);
    let size = comparison.ground_truth().size();
    let Some(sampling) = outcome.sampling.filter(|sampling| sampling.texels.sampled(size).is_some()) else {
        candidates.truncate(count);
        return Ok(candidates);
    };
    let [leading, texels] = CLOSER;
    let rest = candidates.split_off(leading.min(candidates.len()));
    let closer = Sampling { texels: Texels::Sampled(texels), ..sampling };
    let on_more = |scenes: &[Scene]| {
        losses_on_texels(&comparison.clone().on(T::cpu()), &closer, [0, 0], scenes, progress)
    };
    candidates = [sorted(recomputed(&candidates, on_more)?), rest].concat();
    let on_all = |scenes: &[Scene]| comparison.backend().scene_losses(comparison, scenes, None, progress);
    let mut worst = Vec::new();
    for batch in candidates.chunks(BATCH) {
        let mut grown = [worst.clone(), recomputed(batch, on_all)?].concat();
        grown = sorted(grown);
        grown.truncate(count);
        if grown == worst {
            break;
        }
        worst = grown;
    }
    Ok(worst)
}

/// `scenes` with the losses that `losses` gives, of each prediction in each scene.
fn recomputed(
    scenes: &[RankedScene],
    losses: impl Fn(&[Scene]) -> Result<Vec<Vec<f64>>, Error>,
) -> Result<Vec<RankedScene>, Error> {
    let losses = losses(&scenes.iter().map(|ranked| ranked.scene).collect::<Vec<_>>())?;
    let of_scene = |k: usize| losses.iter().map(|of_prediction| of_prediction[k]).collect();
    Ok(scenes
        .iter()
        .enumerate()
        .map(|(k, ranked)| RankedScene { losses: of_scene(k), ..ranked.clone() })
        .collect())
}

fn sorted(mut scenes: Vec<RankedScene>) -> Vec<RankedScene> {
    sort_by_number(&mut scenes, |scene| -scene.total());
    scenes
}

/// How the losses of the scenes of one prediction are distributed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Distribution {
    pub least: f64,
    pub median: f64,
    pub percentile95: f64,
    pub largest: f64,
    /// The number of scenes, and of the worst ones: a tenth, rounded up.
    pub scenes: [usize; 2],
    /// The share of the loss that the worst ones add.
    pub of_worst: f64,
}

impl Distribution {
    /// The distribution of `losses`; `None` where there are none.
    pub fn of(losses: &[f64]) -> Option<Self> {
        let mut sorted = losses.to_vec();
        sorted.sort_by(f64::total_cmp);
        let (&least, &largest) = (sorted.first()?, sorted.last()?);
        let tenth = sorted.len().div_ceil(10);
        let total: f64 = sorted.iter().sum();
        let worst: f64 = sorted[sorted.len() - tenth..].iter().sum();
        Some(Self {
            least,
            median: median(&mut sorted)?,
            percentile95: quantile(&mut sorted, 0.95)?,
            largest,
            scenes: [sorted.len(), tenth],
            of_worst: if total > 0.0 { worst / total } else { 0.0 },
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::diagnose::tests::materials::{generated, unexplained};
    use svbrdf_core::loss::Request;
    use svbrdf_core::model::convention::PRINTED;

    /// The six worst scenes of a loss: by their sampled losses, as they are listed, and by the losses of all scenes on all texels.
    fn worst_six(seed: u64) -> [Vec<RankedScene>; 3] {
        let (truth, progress) = (generated(seed, 64), Progress::default());
        let prediction = unexplained(&truth, seed);
        let comparison = Comparison::new(&truth, &[&prediction], PRINTED).unwrap();
        let outcome = comparison.run(&Request::Accuracy { target: 0.02, seed }, &progress).unwrap();
        let all = comparison.run(&Request::Listed(outcome.scenes.clone()), &progress).unwrap();
        let first_six = |ranked: Vec<RankedScene>| ranked.into_iter().take(6).collect();
        let listed = worst_on_all_texels(&comparison, &outcome, 6, &progress).unwrap();
        [first_six(worst_first(&outcome)), listed, first_six(worst_first(&all))]
    }

    #[test]
    fn the_worst_scenes_are_those_with_the_largest_losses_on_all_texels() {
        for seed in 0..12 {
            let [sampled, listed, of_all] = worst_six(seed);
            let order = |scenes: &[RankedScene]| scenes.iter().map(|ranked| ranked.index).collect::<Vec<_>>();
            assert_ne!(order(&sampled), order(&of_all), "pair {seed}");
            assert_eq!(listed, of_all, "pair {seed}");
        }
    }

    #[test]
    fn the_distribution_of_known_losses() {
        let losses: Vec<f64> = (0..=20).rev().map(f64::from).collect();
        let d = Distribution::of(&losses).unwrap();
        assert_eq!([d.least, d.median, d.percentile95, d.largest], [0.0, 10.0, 19.0, 20.0]);
        assert_eq!(d.scenes, [21, 3]);
        assert!((d.of_worst - (20.0 + 19.0 + 18.0) / 210.0).abs() < 1e-15);
        assert_eq!(Distribution::of(&[]), None);
    }
}
