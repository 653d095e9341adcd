//! A loss over a given number of scenes, with what the first of them say on the way.
//!
//! The i-th scene of a kind depends on the seed and on i alone, and its loss on no other scene. So the scenes done so far
//! are those that a smaller count would have asked for, and the last result is to the bit that of one go.

use std::time::{Duration, Instant};

use super::adaptive::Reached;
use super::{Estimate, Loss, LossParams, Losses};
use crate::error::Error;
use crate::material::Material;
use crate::math::real::Real;
use crate::model::scene::Scene;
use crate::progress::Progress;

/// Scenes that are computed before the first update: as many as the papers take.
const FIRST: usize = 9;
/// A batch grows until it takes this long, or [`SHARE`] of all the time before it.
const BATCH_TIME: Duration = Duration::from_millis(100);
const SHARE: u32 = 16;

/// The losses of `predictions` over the scenes of `params`; `update` sees the losses over growing prefixes of them, the
/// whole at last.
///
/// A prefix has near-field and distant scenes in the proportion of the whole, to within one scene. Where a kind has fewer
/// than two scenes yet, but will have more, the error is not known, and there is no update.
///
/// # Errors
/// As [`crate::loss::losses`].
pub fn losses<T: Real>(
    kernel: Losses<T>,
    ground_truth: &Material<T>,
    predictions: &[&Material<T>],
    params: &LossParams,
    progress: &Progress,
    mut update: impl FnMut(Reached),
) -> Result<(), Error> {
    let scenes = params.scenes()?;
    let (near, distant) = scenes.split_at(params.near);
    let start = Instant::now();
    let mut done = Prefix::new(predictions.len());
    let mut batch = FIRST;
    while done.count() < scenes.len() {
        let batch_start = Instant::now();
        let count = (done.count() + batch).min(scenes.len());
        let near_end = near_part(count, params);
        let new = [&near[done.near..near_end], &distant[done.distant..count - near_end]];
        let after = [done.near, done.distant];
        let losses = params.draw().losses_after(
            after,
            kernel,
            ground_truth,
            predictions,
            &new.concat(),
            &params.convention,
            progress,
        )?;
        done.add(new[0].len(), new[1].len(), losses);
        if done.near >= params.near.min(2) && done.distant >= params.distant.min(2) {
            update(done.reached(near, distant, params, predictions));
        }
        if batch_start.elapsed() < BATCH_TIME.max(start.elapsed() / SHARE) {
            batch *= 2;
        }
    }
    Ok(())
}

/// How many of the first `count` scenes are near-field ones.
fn near_part(count: usize, params: &LossParams) -> usize {
    let total = params.near + params.distant;
    (count * params.near + total / 2) / total
}

/// The losses of the first scenes of either kind.
struct Prefix {
    near: usize,
    distant: usize,
    /// For each prediction the losses of the near-field and of the distant scenes.
    per_scene: Vec<[Vec<f64>; 2]>,
}

impl Prefix {
    fn new(predictions: usize) -> Self {
        Self { near: 0, distant: 0, per_scene: vec![Default::default(); predictions] }
    }

    fn count(&self) -> usize {
        self.near + self.distant
    }

    /// Appends the losses of the next `near` near-field and `distant` distant scenes, in this order.
    fn add(&mut self, near: usize, distant: usize, losses: Vec<Loss>) {
        for ([nears, distants], loss) in self.per_scene.iter_mut().zip(losses) {
            let (a, b) = loss.per_scene.split_at(near);
            nears.extend_from_slice(a);
            distants.extend_from_slice(b);
        }
        self.near += near;
        self.distant += distant;
    }

    fn reached<T: Real>(
        &self,
        near: &[Scene],
        distant: &[Scene],
        params: &LossParams,
        predictions: &[&Material<T>],
    ) -> Reached {
        let sampler = params.sampler;
        let scenes = [&near[..self.near], &distant[..self.distant]].concat();
        let loss = |(prediction, values): (&&Material<T>, &[Vec<f64>; 2])| {
            let per_scene = values.concat();
            let estimate = Estimate::of_sampled(sampler, &scenes, &per_scene);
            Loss { prediction: prediction.name().to_owned(), estimate, per_scene }
        };
        let losses = predictions.iter().zip(&self.per_scene).map(loss).collect();
        Reached { draw: params.draw(), scenes, losses }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::loss::{Texels, losses_of_f32};
    use crate::model::convention::PRINTED;
    use crate::model::sampler::Sampler;
    use crate::samples;

    /// All updates over `near` + `distant` scenes of a seed, and the materials they are for.
    fn run(
        near: usize,
        distant: usize,
        sampler: Sampler,
        texels: Texels,
    ) -> (LossParams, Vec<Reached>, samples::Samples<f32>) {
        let params = LossParams { near, distant, seed: 3, sampler, texels, ..LossParams::default() };
        let samples = samples::load::<f32>().unwrap();
        let predictions: Vec<_> = samples.predictions.iter().map(|read| &read.material).collect();
        let (truth, progress, mut updates) =
            (&samples.ground_truth.material, Progress::default(), Vec::new());
        losses(losses_of_f32, truth, &predictions, &params, &progress, |r| updates.push(r)).unwrap();
        (params, updates, samples)
    }

    /// What one go over `params` gives.
    fn one_go(params: &LossParams, samples: &samples::Samples<f32>) -> (Vec<Scene>, Vec<Loss>) {
        let scenes = params.scenes().unwrap();
        let predictions: Vec<_> = samples.predictions.iter().map(|read| &read.material).collect();
        let (truth, progress) = (&samples.ground_truth.material, Progress::default());
        let losses = params.draw().losses(losses_of_f32, truth, &predictions, &scenes, &PRINTED, &progress);
        (scenes, losses.unwrap())
    }

    #[test]
    fn every_update_is_to_the_bit_what_fewer_scenes_give_in_one_go_and_the_last_what_all_do() {
        for (near, distant, sampler, texels) in [
            (6, 3, Sampler::Random, Texels::All),
            (40, 20, Sampler::Random, Texels::All),
            (61, 13, Sampler::Sobol, Texels::All),
            (0, 30, Sampler::Random, Texels::All),
            (61, 13, Sampler::Sobol, Texels::Sampled(40)),
        ] {
            let (params, updates, samples) = run(near, distant, sampler, texels);
            assert_eq!(updates.len() > 1, near + distant > FIRST, "{near} + {distant}");
            for reached in &updates {
                let is_near = |s: &&Scene| s.kind == crate::model::scene::Kind::Near;
                let nears = reached.scenes.iter().filter(is_near).count();
                let count = reached.scenes.len();
                let share = nears as f64 - (count * near) as f64 / (near + distant) as f64;
                assert!(share.abs() <= 0.5, "{nears} of {count} scenes are near-field ones");
                let fewer = LossParams { near: nears, distant: count - nears, ..params.clone() };
                let (scenes, losses) = one_go(&fewer, &samples);
                assert_eq!((&reached.scenes, &reached.losses), (&scenes, &losses));
            }
            let (scenes, losses) = one_go(&params, &samples);
            let last = updates.last().unwrap();
            assert_eq!((&last.scenes, &last.losses), (&scenes, &losses));
        }
    }

    #[test]
    fn no_update_has_an_unknown_error_where_the_whole_has_a_known_one() {
        let (_, updates, _) = run(58, 2, Sampler::Random, Texels::All);
        let known = |r: &Reached| r.losses.iter().all(|loss| loss.estimate.standard_error.is_some());
        assert!(!updates.is_empty() && updates.iter().all(known), "{updates:?}");
        let (_, updates, _) = run(1, 1, Sampler::Random, Texels::All);
        assert_eq!(updates.len(), 1, "what is unknown at last is shown");
    }

    #[test]
    fn a_cancelled_loss_ends_with_the_error_that_says_so() {
        let samples = samples::load::<f32>().unwrap();
        let progress = Progress::default();
        let params = LossParams { near: 600, distant: 300, ..LossParams::default() };
        let mut count = 0;
        let predictions = [&samples.predictions[0].material];
        let result =
            losses(losses_of_f32, &samples.ground_truth.material, &predictions, &params, &progress, |_| {
                count += 1;
                progress.cancel();
            });
        assert!(matches!(result, Err(Error::Cancelled)), "{result:?}");
        assert_eq!(count, 1, "there is no update after the one that cancelled");
    }
}
