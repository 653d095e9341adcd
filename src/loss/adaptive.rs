//! As many scenes as a given accuracy or a given time needs, from scrambled Sobol sequences.
//!
//! Stopping where the error looks small favours draws whose error looks smaller than it is. So the scenes that decide
//! how many are needed are not those that give the loss: a run of one size predicts the size of the next, whose
//! scenes are independent of it (Stein 1945, with fresh samples in place of his pilot). The first run of a predicted
//! size gives a loss without bias and an interval of a fixed size. Only where this still misses the accuracy
//! does it predict another; the prediction is generous, so that this is rare.

use std::time::{Duration, Instant};

use super::{Estimate, Loss, Losses, Weights, check};
use crate::convention::Convention;
use crate::error::Error;
use crate::material::Material;
use crate::progress::Progress;
use crate::real::Real;
use crate::sampler::{REPLICATES, Sampler};
use crate::scene::Scene;

/// Near-field scenes for each distant one; both kinds keep the weights 2 : 1 of Algorithm 1's 6 + 3 scenes.
///
/// Near-field losses spread more, count twice, and need 6 dimensions for 4, so most of the error is theirs.
const NEAR_PER_DISTANT: usize = 4;
/// Near-field points of each scrambling in the first run.
const PILOT: usize = 16;
/// Most near-field points of each scrambling.
const MOST: usize = 1 << 16;
/// The variance of a run falls at least as this power of its size (measured: -1.6 to -2).
const RATE: f64 = 1.6;
/// A run is planned for this share of the error that is asked for: its own error is only estimated.
const MARGIN: f64 = 0.7;

/// When to stop.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Goal {
    /// Half of the 95% interval of every loss is at most this share of the loss.
    RelativeError(f64),
    /// This much time has passed.
    Time(Duration),
}

impl Default for Goal {
    fn default() -> Self {
        Self::RelativeError(0.01)
    }
}

/// What an adaptive run has reached.
#[derive(Clone, Debug, PartialEq)]
pub struct Reached {
    pub sampler: Sampler,
    pub weights: Weights,
    pub scenes: Vec<Scene>,
    pub losses: Vec<Loss>,
}

/// The losses of `predictions`, with as many scenes as `goal` needs; `update` sees every run, cheapest first.
///
/// A cancelled run gives what was reached before it. A size is doubled until the time is up, whatever the losses
/// are, so that a time cannot bias them; the last doubling is left out where it would not fit.
///
/// # Errors
/// As [`super::losses`]; [`Error::Cancelled`] only before the first run is done.
#[expect(clippy::too_many_arguments, reason = "those of a loss, and what is asked for")]
pub fn losses<T: Real>(
    kernel: Losses<T>,
    ground_truth: &Material<T>,
    predictions: &[&Material<T>],
    seed: u64,
    convention: &Convention,
    goal: Goal,
    progress: &Progress,
    mut update: impl FnMut(&Reached),
) -> Result<Reached, Error> {
    let start = Instant::now();
    let mut size = match goal {
        Goal::RelativeError(_) => PILOT,
        Goal::Time(_) => NEAR_PER_DISTANT,
    };
    let mut best: Option<Reached> = None;
    for stage in 0.. {
        let run_start = Instant::now();
        let (near, distant) = (size * REPLICATES, size / NEAR_PER_DISTANT * REPLICATES);
        let scenes = Sampler::Sobol.scenes(stage_seed(seed, stage), near, distant, convention);
        check(ground_truth, predictions, &scenes)?;
        let losses = match (kernel(ground_truth, predictions, &scenes, convention, progress), best.take()) {
            (Err(Error::Cancelled), Some(reached)) => return Ok(reached),
            (losses, _) => losses?,
        };
        let weighted = |loss: Loss| Loss {
            estimate: Estimate::weighted(Weights::TwoToOne, Sampler::Sobol, &scenes, &loss.per_scene),
            ..loss
        };
        let losses: Vec<Loss> = losses.into_iter().map(weighted).collect();
        let reached = Reached { sampler: Sampler::Sobol, weights: Weights::TwoToOne, scenes, losses };
        update(&reached);
        let next = match goal {
            Goal::RelativeError(target) => next_size(size, target, stage, &reached.losses),
            // A run of twice the size takes twice as long.
            Goal::Time(time) => (start.elapsed() + 2 * run_start.elapsed() <= time).then_some(2 * size),
        };
        match next.filter(|next| *next <= MOST) {
            None => return Ok(reached),
            Some(next) => size = next,
        }
        best = Some(reached);
    }
    best.ok_or(Error::Cancelled)
}

/// The size of the next run; `None` where this one does. The first is a pilot and never does.
fn next_size(size: usize, target: f64, stage: u64, losses: &[Loss]) -> Option<usize> {
    let error = losses.iter().map(|loss| loss.estimate.relative_error95()).fold(0.0, f64::max);
    if stage > 0 && error <= target {
        return None;
    }
    let factor = (error / (MARGIN * target)).powf(2.0 / RATE).clamp(0.25, MOST as f64);
    let wanted = ((size as f64 * factor) as usize).next_power_of_two().clamp(NEAR_PER_DISTANT, MOST);
    if stage == 0 {
        Some(wanted)
    } else {
        // The size that was enough by its prediction was not.
        (size < MOST).then(|| wanted.max(2 * size).min(MOST))
    }
}

/// The seed of the scenes of a stage: independent of those of other stages.
fn stage_seed(seed: u64, stage: u64) -> u64 {
    /// 2^64 over the golden ratio: the steps of SplitMix64.
    const STEP: u64 = 0x9e37_79b9_7f4a_7c15;
    seed.wrapping_add(STEP.wrapping_mul(stage + 1))
}
