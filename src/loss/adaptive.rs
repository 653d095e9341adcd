//! As many scenes as a given accuracy or a given time needs: scrambled Sobol sequences, each scene on a few texels of
//! its own.
//!
//! Stopping where the error looks small favours draws whose error looks smaller than it is. So the scenes that decide
//! how many are needed are not among those that give the loss: a pilot predicts the size of a run whose scenes are
//! independent of it (Stein 1945, with fresh samples in place of his pilot). This run gives a loss without bias and an
//! interval of a fixed size. Only where it still misses the accuracy do more scenes join it; the prediction is
//! generous, so that this is rare, and none are ever dropped for their error.

use std::time::{Duration, Instant};

use super::{Draw, Estimate, Loss, Losses, Texels};
use crate::convention::Convention;
use crate::error::Error;
use crate::material::Material;
use crate::progress::Progress;
use crate::real::Real;
use crate::sampler::{REPLICATES, Sampler};
use crate::scene::Scene;

/// Texels of each scene. With fewer, scenes that are hardly seen take most of the time; with more, texels do that add
/// little.
pub const TEXELS: usize = 128;
/// Near-field scenes for each distant one, as Algorithm 1 has 6 and 3: this is their share in the loss.
const NEAR_PER_DISTANT: usize = 2;
/// Distant scenes of each scrambling in the first run.
const PILOT: usize = 8;
/// Most distant scenes of each scrambling.
const MOST: usize = 1 << 15;
/// The variance of a run is assumed to fall as this power of its size. Where it falls more slowly, another run follows.
const RATE: f64 = 1.5;
/// A run is planned for this share of the error that is asked for: its own error is only estimated.
const MARGIN: f64 = 0.75;

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
    /// How the scenes and their texels were drawn; the first of them, where several runs were joined.
    pub draw: Draw,
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
        Goal::Time(_) => 1,
    };
    let mut best: Option<Reached> = None;
    for stage in 0.. {
        let run_start = Instant::now();
        let distant = size * REPLICATES;
        let draw =
            Draw { sampler: Sampler::Sobol, seed: stage_seed(seed, stage), texels: Texels::Sampled(TEXELS) };
        let scenes = draw.sampler.scenes(draw.seed, NEAR_PER_DISTANT * distant, distant, convention);
        let losses = draw.losses(kernel, ground_truth, predictions, &scenes, convention, progress);
        let (losses, earlier) = match (losses, best.take()) {
            (Err(Error::Cancelled), Some(reached)) => return Ok(reached),
            (losses, earlier) => (losses?, earlier),
        };
        let run = Reached { draw, scenes, losses };
        let reached = match (goal, earlier) {
            // The pilot decides, and does not count.
            (Goal::RelativeError(_), Some(_)) if stage == 1 => run,
            (_, Some(earlier)) => earlier.joined_by(run),
            (_, None) => run,
        };
        update(&reached);
        let next = match goal {
            Goal::RelativeError(target) => next_size(reached.size(), target, stage, &reached.losses),
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

impl Reached {
    /// Distant scenes of each scrambling.
    fn size(&self) -> usize {
        self.scenes.len() / (REPLICATES * (1 + NEAR_PER_DISTANT))
    }

    /// Both together. Each has as many scenes of every scrambling, so that they still come in turns.
    fn joined_by(mut self, other: Self) -> Self {
        self.scenes.extend(other.scenes);
        for (loss, more) in self.losses.iter_mut().zip(other.losses) {
            loss.per_scene.extend(more.per_scene);
            loss.estimate = Estimate::of_sampled(self.draw.sampler, &self.scenes, &loss.per_scene);
        }
        self
    }
}

/// The size of the next run after a total of `size`; `None` where that does. The first is a pilot and never does.
fn next_size(size: usize, target: f64, stage: u64, losses: &[Loss]) -> Option<usize> {
    let error = losses.iter().map(|loss| loss.estimate.relative_error95()).fold(0.0, f64::max);
    if stage > 0 && error <= target {
        return None;
    }
    let factor = (error / (MARGIN * target)).powf(2.0 / RATE).clamp(0.25, MOST as f64);
    let wanted = rounded((size as f64 * factor).ceil() as usize).clamp(1, MOST);
    if stage == 0 {
        Some(wanted)
    } else {
        // The size that was enough by its prediction was not.
        (size < MOST).then(|| rounded(wanted.saturating_sub(size).max(size / 2)).clamp(1, MOST))
    }
}

/// The next 2^k or 3 x 2^k: Sobol sequences of these lengths are even, and steps are short.
fn rounded(size: usize) -> usize {
    let power = size.next_power_of_two();
    if size <= power / 4 * 3 { power / 4 * 3 } else { power }
}

/// The seed of the scenes of a stage: independent of those of other stages.
fn stage_seed(seed: u64, stage: u64) -> u64 {
    /// 2^64 over the golden ratio: the steps of SplitMix64.
    const STEP: u64 = 0x9e37_79b9_7f4a_7c15;
    seed.wrapping_add(STEP.wrapping_mul(stage + 1))
}
