//! As many scenes as a given accuracy or a given time needs: scrambled Sobol sequences, each scene on a few texels of
//! its own.
//!
//! Stopping where the error looks small favours draws whose error looks smaller than it is. So the scenes that decide
//! how many are needed are not among those that give the loss: a pilot predicts the size of a run whose scenes are
//! independent of it (Stein 1945, with fresh samples in place of his pilot). This run gives a loss without bias and an
//! interval of a fixed size. Only where it still misses the accuracy does it go on; the prediction is generous, so that
//! this is rare, and none are ever dropped for their error. To go on favours draws that look quiet after all: it makes
//! losses low by less than a twentieth of the accuracy (up to 0.11% at +-3%).
//!
//! A run that stops because its error looks small has seen none of the scenes that make it large. The pilot, which has scenes of
//! its own, tells of them: where it predicts a larger error, its prediction is a quarter of the variance of the interval. That
//! takes no scene more. On seventeen pairs and accuracies the intervals then hold the loss in 94.3 to 96.7% of the seeds,
//! and without it in 93.6 to 96.0% (docs/statistics.md).
//!
//! The scenes that count are always the first ones of one draw: whoever asks for as many of its seed gets the same loss.

use std::time::{Duration, Instant};

use super::comparison::{Comparison, Compute};
use super::outcome::Outcome;
use super::request::{Sampling, Texels};
use super::texels::scene_losses;
use crate::error::Error;
use crate::model::sampler::{REPLICATES, Sampler};
use crate::progress::Progress;

/// Texels of each scene. In two-stage sampling the best number is the root of cost of a scene / cost of a texel x variance within
/// scenes / variance between them (Cochran 1977, 10.6): 16 to 64 on eleven pairs, of whose times 32 takes at most 1.29
/// (docs/statistics.md).
pub const TEXELS: usize = 32;
/// Near-field scenes for each distant one, as Algorithm 1 has 6 and 3: this is their share in the loss.
pub const NEAR_PER_DISTANT: usize = 2;
/// Distant scenes of each scrambling in the pilot.
const PILOT: usize = 8;
/// Most distant scenes of each scrambling.
const MOST: usize = 1 << 15;
/// Most scenes of a loss, unless a comparison has a limit of its own.
pub const MOST_SCENES: usize = MOST * REPLICATES * (1 + NEAR_PER_DISTANT);
/// The variance of a run is assumed to fall as this power of its size. Where it falls more slowly, it goes on.
const RATE: f64 = 1.5;
/// A run is planned for this share of the error that is asked for: its own error is only estimated.
const MARGIN: f64 = 0.75;
/// The share of the pilot's estimate in the variance of a run, where it is the larger of the two.
const SHARE_OF_PILOT: f64 = 0.25;

/// When to stop.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Goal {
    /// Half of the 95% interval of every loss is at most this share of the loss.
    RelativeError(f64),
    /// This much time has passed.
    Time(Duration),
}

/// The losses of a comparison with as many scenes as `goal` needs; `update` sees every step, cheapest first.
///
/// A cancelled run gives what was reached before it. A size is doubled until the time is up, whatever the losses
/// are, so that a time cannot bias them; the last doubling is left out where it would not fit.
///
/// # Errors
/// As [`Comparison::run`]; [`Error::Cancelled`] only before the first step is done.
pub(super) fn run<T: Compute>(
    comparison: &Comparison<'_, T>,
    goal: Goal,
    seed: u64,
    progress: &Progress,
    mut update: impl FnMut(&Outcome),
) -> Result<Outcome, Error> {
    let start = Instant::now();
    let most = largest_size(comparison.most_scenes().unwrap_or(MOST_SCENES));
    let (mut size, mut best) = match goal {
        Goal::RelativeError(target) => {
            let pilot = step(comparison, pilot_seed(seed), PILOT, None, progress)?;
            update(&pilot);
            (planned_size(PILOT, target, &pilot).min(most), Some(pilot))
        }
        Goal::Time(_) => (1, None),
    };
    let pilot_errors = best.as_ref().map(relative_errors);
    loop {
        let step_start = Instant::now();
        // The pilot decides, and does not count.
        let known = best.as_ref().filter(|best| best.sampling.is_some_and(|s| s.seed == seed));
        let mut outcome = match (step(comparison, seed, size, known, progress), best) {
            (Err(Error::Cancelled), Some(best)) => return Ok(best),
            (outcome, _) => outcome?,
        };
        if let Some(errors) = &pilot_errors {
            widen(&mut outcome, errors, size);
        }
        update(&outcome);
        let next = match goal {
            Goal::RelativeError(target) if outcome.relative_error95() <= target => None,
            // The size that was enough by its prediction was not.
            Goal::RelativeError(target) => {
                Some(planned_size(size, target, &outcome).max(rounded(size + size.div_ceil(2))))
            }
            // To double the size takes as long as all so far, twice as long as the last doubling.
            Goal::Time(time) => (start.elapsed() + 2 * step_start.elapsed() <= time).then_some(2 * size),
        };
        match next.map(|next| next.min(most)).filter(|next| *next > size) {
            None => return Ok(outcome),
            Some(next) => size = next,
        }
        best = Some(outcome);
    }
}

/// The losses over the first `size` distant scenes of each scrambling and twice as many near-field ones, of which
/// `known` ones are not rendered again.
fn step<T: Compute>(
    comparison: &Comparison<'_, T>,
    seed: u64,
    size: usize,
    known: Option<&Outcome>,
    progress: &Progress,
) -> Result<Outcome, Error> {
    let distant = size * REPLICATES;
    let near = NEAR_PER_DISTANT * distant;
    let sampling = Sampling { near, distant, seed, sampler: Sampler::Sobol, texels: Texels::Sampled(TEXELS) };
    let scenes = sampling.scenes(comparison.convention())?;
    let before = known.map_or(0, |known| known.scenes.len() / (1 + NEAR_PER_DISTANT));
    let before = [NEAR_PER_DISTANT * before, before];
    let (near, distant) = scenes.split_at(near);
    let new = [&near[before[0]..], &distant[before[1]..]].concat();
    let mut per_scene = scene_losses(comparison, &sampling, before, &new, progress)?;
    for (values, known) in per_scene.iter_mut().zip(known.map_or(&[][..], |known| &known.losses)) {
        let (old_near, old_distant) = known.per_scene.split_at(before[0]);
        let (near, distant) = values.split_at(near.len() - before[0]);
        *values = [old_near, near, old_distant, distant].concat();
    }
    Ok(comparison.outcome(Some(sampling), scenes, per_scene, None))
}

fn relative_errors(outcome: &Outcome) -> Vec<f64> {
    outcome.losses.iter().map(|loss| loss.estimate.relative_error95()).collect()
}

/// Widens the intervals of a run of `size` by what its pilot, whose relative errors are `pilot`, predicts for it.
fn widen(outcome: &mut Outcome, pilot: &[f64], size: usize) {
    for (loss, pilot) in outcome.losses.iter_mut().zip(pilot) {
        let own = loss.estimate.relative_error95();
        loss.estimate = loss.estimate.widened(widening(own, *pilot, size));
    }
}

/// How many times as wide the interval of a run of `size` is for its pilot's sake: at least once. Both errors are relative.
fn widening(own: f64, pilot: f64, size: usize) -> f64 {
    let fall = (PILOT as f64 / size as f64).min(1.0).powf(RATE);
    let excess = (fall * (pilot / own).powi(2) - 1.0).max(0.0);
    // Infinite where a run has no error.
    if excess.is_finite() { (1.0 + SHARE_OF_PILOT * excess).sqrt() } else { 1.0 }
}

/// The size of a run that `target` needs, by the losses of a run of `size`.
fn planned_size(size: usize, target: f64, outcome: &Outcome) -> usize {
    let factor = (outcome.relative_error95() / (MARGIN * target)).powf(2.0 / RATE).clamp(0.25, MOST as f64);
    rounded((size as f64 * factor).ceil() as usize).clamp(1, MOST)
}

/// The next 2^k or 3 x 2^k: Sobol sequences of these lengths are even, and steps are short.
fn rounded(size: usize) -> usize {
    let power = size.next_power_of_two();
    if size <= power / 4 * 3 { power / 4 * 3 } else { power }
}

/// The largest size of a run with at most `scenes` scenes.
fn largest_size(scenes: usize) -> usize {
    let size = (scenes / (REPLICATES * (1 + NEAR_PER_DISTANT))).clamp(1, MOST);
    match rounded(size) {
        even if even == size => size,
        above if above.is_power_of_two() => above / 4 * 3,
        above => above / 3 * 2,
    }
}

/// The seed of the pilot of a run: its scenes are independent of those of the run.
fn pilot_seed(seed: u64) -> u64 {
    /// 2^64 over the golden ratio: the step of SplitMix64.
    const STEP: u64 = 0x9e37_79b9_7f4a_7c15;
    seed.wrapping_add(STEP)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_run_that_looks_better_than_its_pilot_predicts_has_a_wider_interval_and_none_a_narrower_one() {
        // An eighth of 16 times the variance is twice the run's own: a quarter of the excess is added.
        assert_eq!(widening(0.01, 0.04, 4 * PILOT), 1.25f64.sqrt());
        for (own, pilot) in [(0.01, 0.01), (0.01, 0.0), (0.0, 0.04), (0.0, 0.0)] {
            assert_eq!(widening(own, pilot, 4 * PILOT), 1.0, "{own} {pilot}");
        }
    }

    #[test]
    fn a_limit_of_scenes_is_the_largest_even_size_below() {
        for scenes in
            [1, 24, 25, 47, 48, 71, 72, 95, 96, 10_000, 24_575, 24_576, 49_152, MOST_SCENES, usize::MAX]
        {
            let size = largest_size(scenes);
            let next = rounded(size + 1);
            assert_eq!(rounded(size), size, "{scenes}");
            assert!(
                24 * size <= scenes.max(24) && (24 * next > scenes || next > MOST),
                "{scenes}: {size}, {next}"
            );
        }
    }
}
