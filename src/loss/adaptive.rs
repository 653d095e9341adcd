//! As many scenes as a given accuracy or a given time needs: scrambled Sobol sequences, each scene on a few texels of
//! its own.
//!
//! Stopping where the error looks small favours draws whose error looks smaller than it is. So the scenes that decide
//! how many are needed are not among those that give the loss: a pilot predicts the size of a run whose scenes are
//! independent of it (Stein 1945, with fresh samples in place of his pilot). This run gives a loss without bias and an
//! interval of a fixed size. Only where it still misses the accuracy does it go on; the prediction is generous, so that
//! this is rare, and none are ever dropped for their error. To go on favours draws that look quiet after all: it makes
//! losses low by less than a tenth of their error (0.01 to 0.05% at +-3%, less than can be seen in 2,000 seeds at +-1%).
//!
//! The scenes that count are always the first ones of one draw: whoever asks for as many of its seed gets the same loss.

use std::time::{Duration, Instant};

use super::{Draw, Estimate, Loss, Losses, Texels};
use crate::error::Error;
use crate::material::Material;
use crate::math::real::Real;
use crate::model::convention::Convention;
use crate::model::sampler::{REPLICATES, Sampler};
use crate::model::scene::Scene;
use crate::progress::Progress;

/// Texels of each scene. With fewer, scenes that are hardly seen take most of the time; with more, texels do that add
/// little.
pub const TEXELS: usize = 128;
/// Near-field scenes for each distant one, as Algorithm 1 has 6 and 3: this is their share in the loss.
const NEAR_PER_DISTANT: usize = 2;
/// Distant scenes of each scrambling in the pilot.
const PILOT: usize = 8;
/// Most distant scenes of each scrambling.
const MOST: usize = 1 << 15;
/// Most scenes of a loss.
pub const MOST_SCENES: usize = MOST * REPLICATES * (1 + NEAR_PER_DISTANT);
/// The variance of a run is assumed to fall as this power of its size. Where it falls more slowly, it goes on.
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

impl Goal {
    /// Whether finished `losses` are what was asked for: an accuracy may need more than [`MOST_SCENES`].
    pub fn is_met_by(self, losses: &[Loss]) -> bool {
        match self {
            Self::RelativeError(target) => relative_error95(losses) <= target,
            Self::Time(_) => true,
        }
    }
}

/// The largest [`Estimate::relative_error95`] of any of `losses`.
pub fn relative_error95(losses: &[Loss]) -> f64 {
    losses.iter().map(|loss| loss.estimate.relative_error95()).fold(0.0, f64::max)
}

/// What an adaptive run has reached.
#[derive(Clone, Debug, PartialEq)]
pub struct Reached {
    /// How the scenes and their texels were drawn.
    pub draw: Draw,
    /// The first scenes of `draw`, near-field ones before distant ones.
    pub scenes: Vec<Scene>,
    pub losses: Vec<Loss>,
}

/// The losses of `predictions`, with as many scenes as `goal` needs; `update` sees every step, cheapest first.
///
/// A cancelled run gives what was reached before it. A size is doubled until the time is up, whatever the losses
/// are, so that a time cannot bias them; the last doubling is left out where it would not fit.
///
/// # Errors
/// As [`super::losses`]; [`Error::Cancelled`] only before the first step is done.
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
    // The first `size` scenes of a draw, of which `known` ones need not be rendered again.
    let run = |seed, size: usize, known: Option<&Reached>| -> Result<Reached, Error> {
        let distant = size * REPLICATES;
        let draw = Draw { sampler: Sampler::Sobol, seed, texels: Texels::Sampled(TEXELS) };
        let scenes = draw.sampler.scenes(draw.seed, NEAR_PER_DISTANT * distant, distant, convention);
        let before = known.map_or(0, |known| known.scenes.len() / (1 + NEAR_PER_DISTANT));
        let before = [NEAR_PER_DISTANT * before, before];
        let (near, distant) = scenes.split_at(NEAR_PER_DISTANT * distant);
        let new = [&near[before[0]..], &distant[before[1]..]].concat();
        let new_near = near.len() - before[0];
        let mut losses =
            draw.losses_after(before, kernel, ground_truth, predictions, &new, convention, progress)?;
        for (loss, known) in losses.iter_mut().zip(known.map_or(&[][..], |known| &known.losses)) {
            let (old_near, old_distant) = known.per_scene.split_at(before[0]);
            let (near, distant) = loss.per_scene.split_at(new_near);
            loss.per_scene = [old_near, near, old_distant, distant].concat();
            loss.estimate = Estimate::of_sampled(draw.sampler, &scenes, &loss.per_scene);
        }
        Ok(Reached { draw, scenes, losses })
    };
    let (mut size, mut best) = match goal {
        Goal::RelativeError(target) => {
            let pilot = run(pilot_seed(seed), PILOT, None)?;
            update(&pilot);
            (planned_size(PILOT, target, &pilot.losses), Some(pilot))
        }
        Goal::Time(_) => (1, None),
    };
    loop {
        let step = Instant::now();
        // The pilot decides, and does not count.
        let known = best.as_ref().filter(|best| best.draw.seed == seed);
        let reached = match (run(seed, size, known), best) {
            (Err(Error::Cancelled), Some(best)) => return Ok(best),
            (run, _) => run?,
        };
        update(&reached);
        let next = match goal {
            Goal::RelativeError(_) if goal.is_met_by(&reached.losses) => None,
            // The size that was enough by its prediction was not.
            Goal::RelativeError(target) => {
                Some(planned_size(size, target, &reached.losses).max(rounded(size + size.div_ceil(2))))
            }
            // To double the size takes as long as all so far, twice as long as the last doubling.
            Goal::Time(time) => (start.elapsed() + 2 * step.elapsed() <= time).then_some(2 * size),
        };
        match next.map(|next| next.min(MOST)).filter(|next| *next > size) {
            None => return Ok(reached),
            Some(next) => size = next,
        }
        best = Some(reached);
    }
}

/// The size of a run that `target` needs, by the losses of a run of `size`.
fn planned_size(size: usize, target: f64, losses: &[Loss]) -> usize {
    let factor = (relative_error95(losses) / (MARGIN * target)).powf(2.0 / RATE).clamp(0.25, MOST as f64);
    rounded((size as f64 * factor).ceil() as usize).clamp(1, MOST)
}

/// The next 2^k or 3 x 2^k: Sobol sequences of these lengths are even, and steps are short.
fn rounded(size: usize) -> usize {
    let power = size.next_power_of_two();
    if size <= power / 4 * 3 { power / 4 * 3 } else { power }
}

/// The seed of the pilot of a run: its scenes are independent of those of the run.
fn pilot_seed(seed: u64) -> u64 {
    /// 2^64 over the golden ratio: the step of SplitMix64.
    const STEP: u64 = 0x9e37_79b9_7f4a_7c15;
    seed.wrapping_add(STEP)
}
