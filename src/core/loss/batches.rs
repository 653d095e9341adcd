//! A loss over a given number of scenes, with what the first of them say on the way.
//!
//! The i-th scene of a kind depends on the seed and on i alone, and its loss on no other scene. So the scenes done so far
//! are those that a smaller count would have asked for, and the last result has the same bits as a run in one go.

use std::time::{Duration, Instant};

use super::comparison::{Comparison, Compute};
use super::outcome::Outcome;
use super::request::Sampling;
use super::texels::scene_losses;
use crate::error::Error;
use crate::progress::Progress;

/// Scenes that are computed before the first update: as many as the papers take.
const FIRST: usize = 9;
/// A batch grows until it takes this long, or [`SHARE`] of all the time before it.
const BATCH_TIME: Duration = Duration::from_millis(100);
const SHARE: u32 = 16;

/// The losses over the scenes of `sampling`; `update` sees the losses over growing prefixes of them, the whole at last.
///
/// A prefix has near-field and distant scenes in the proportion of the whole, to within one scene. Where a kind has fewer
/// than two scenes yet, but will have more, the error is not known, and there is no update.
///
/// # Errors
/// As [`Comparison::run`].
pub(super) fn run<T: Compute>(
    comparison: &Comparison<'_, T>,
    sampling: &Sampling,
    progress: &Progress,
    mut update: impl FnMut(&Outcome),
) -> Result<Outcome, Error> {
    let scenes = sampling.scenes(comparison.convention())?;
    let (near, distant) = scenes.split_at(sampling.near);
    let start = Instant::now();
    let mut done = Prefix::new(comparison.predictions().len());
    let mut batch = FIRST;
    loop {
        let batch_start = Instant::now();
        let count = (done.count() + batch).min(scenes.len());
        let near_end = near_part(count, sampling);
        let new = [&near[done.near..near_end], &distant[done.distant..count - near_end]];
        let before = [done.near, done.distant];
        let losses = scene_losses(comparison, sampling, before, &new.concat(), progress)?;
        done.add(new[0].len(), new[1].len(), losses);
        let is_last = done.count() == scenes.len();
        if is_last || (done.near >= sampling.near.min(2) && done.distant >= sampling.distant.min(2)) {
            let reached = Sampling { near: done.near, distant: done.distant, ..*sampling };
            let scenes = [&near[..done.near], &distant[..done.distant]].concat();
            let pilot = comparison.pilot(&reached, progress)?;
            let outcome = comparison.outcome(Some(reached), scenes, done.per_scene(), pilot);
            update(&outcome);
            if is_last {
                return Ok(outcome);
            }
        }
        if batch_start.elapsed() < BATCH_TIME.max(start.elapsed() / SHARE) {
            batch *= 2;
        }
    }
}

/// How many of the first `count` scenes are near-field ones.
fn near_part(count: usize, sampling: &Sampling) -> usize {
    let total = sampling.near + sampling.distant;
    (count * sampling.near + total / 2) / total
}

/// The losses of the first scenes of either kind.
struct Prefix {
    near: usize,
    distant: usize,
    /// For each prediction the losses of the near-field and of the distant scenes.
    losses: Vec<[Vec<f64>; 2]>,
}

impl Prefix {
    fn new(predictions: usize) -> Self {
        Self { near: 0, distant: 0, losses: vec![Default::default(); predictions] }
    }

    fn count(&self) -> usize {
        self.near + self.distant
    }

    /// Appends the losses of the next `near` near-field and `distant` distant scenes, in this order.
    fn add(&mut self, near: usize, distant: usize, losses: Vec<Vec<f64>>) {
        for ([nears, distants], per_scene) in self.losses.iter_mut().zip(losses) {
            let (a, b) = per_scene.split_at(near);
            nears.extend_from_slice(a);
            distants.extend_from_slice(b);
        }
        self.near += near;
        self.distant += distant;
    }

    /// For each prediction the losses of the scenes so far, near-field ones first.
    fn per_scene(&self) -> Vec<Vec<f64>> {
        self.losses.iter().map(|kinds| kinds.concat()).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::loss::{Request, Texels};
    use crate::material::{Material, Planes};
    use crate::model::convention::PRINTED;
    use crate::model::sampler::Sampler;
    use crate::model::scene::{Kind, Scene};

    /// Waves of this phase in every map.
    fn waves(name: &str, phase: f32) -> Material<f32> {
        const SIDE: usize = 64;
        let plane = |number: usize, least: f32, most: f32| -> Vec<f32> {
            let value = |texel: usize| {
                let angle = (texel * (number + 1)) as f32 * 0.37 + phase * (number + 1) as f32;
                least + (most - least) * (0.5 + 0.5 * angle.sin())
            };
            (0..SIDE * SIDE).map(value).collect()
        };
        let planes = Planes {
            normal: [plane(0, -0.4, 0.4), plane(1, -0.4, 0.4), plane(2, 0.8, 1.0)],
            diffuse: [3, 4, 5].map(|number| plane(number, 0.05, 0.9)),
            specular: [6, 7, 8].map(|number| plane(number, 0.02, 0.6)),
            roughness: plane(9, 0.15, 0.9),
        };
        Material::new(name, SIDE, SIDE, planes).unwrap()
    }

    /// Two predictions, compared with a ground truth.
    fn compare<R>(work: impl FnOnce(&Comparison<'_, f32>) -> R) -> R {
        let [truth, near, far] = [("truth", 0.0), ("near", 0.1), ("far", 1.0)].map(|(n, p)| waves(n, p));
        work(&Comparison::new(&truth, &[&near, &far], PRINTED).unwrap())
    }

    /// All updates over the scenes of `sampling`.
    fn updates(comparison: &Comparison<'_, f32>, sampling: &Sampling) -> Vec<Outcome> {
        let mut updates = Vec::new();
        let request = Request::Scenes(*sampling);
        let last = comparison.stream(&request, &Progress::default(), |o| updates.push(o.clone())).unwrap();
        assert_eq!(updates.last(), Some(&last));
        updates
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
            compare(|comparison| {
                let sampling = Sampling { near, distant, seed: 3, sampler, texels };
                let one_go = |s: Sampling| comparison.run(&Request::Scenes(s), &Progress::default()).unwrap();
                let updates = updates(comparison, &sampling);
                assert_eq!(updates.len() > 1, near + distant > FIRST, "{near} + {distant}");
                for reached in &updates {
                    let is_near = |s: &&Scene| s.kind == Kind::Near;
                    let nears = reached.scenes.iter().filter(is_near).count();
                    let count = reached.scenes.len();
                    let share = nears as f64 - (count * near) as f64 / (near + distant) as f64;
                    assert!(share.abs() <= 0.5, "{nears} of {count} scenes are near-field ones");
                    assert_eq!(
                        *reached,
                        one_go(Sampling { near: nears, distant: count - nears, ..sampling })
                    );
                }
                assert_eq!(updates.last(), Some(&one_go(sampling)));
            });
        }
    }

    #[test]
    fn no_update_has_an_unknown_error_where_the_whole_has_a_known_one() {
        let random = |near, distant| Sampling { near, distant, seed: 3, ..Sampling::default() };
        compare(|comparison| {
            let known = |r: &Outcome| r.losses.iter().all(|loss| loss.estimate.standard_error.is_some());
            let updates_60 = updates(comparison, &random(58, 2));
            assert!(!updates_60.is_empty() && updates_60.iter().all(known), "{updates_60:?}");
            assert_eq!(updates(comparison, &random(1, 1)).len(), 1, "the last one is shown, known or not");
        });
    }

    #[test]
    fn a_cancelled_loss_ends_with_the_error_that_says_so() {
        compare(|comparison| {
            let progress = Progress::default();
            let request = Request::Scenes(Sampling { near: 600, distant: 300, ..Sampling::default() });
            let mut count = 0;
            let result = comparison.stream(&request, &progress, |_| {
                count += 1;
                progress.cancel();
            });
            assert!(matches!(result, Err(Error::Cancelled)), "{result:?}");
            assert_eq!(count, 1, "there is no update after the one that cancelled");
        });
    }
}
