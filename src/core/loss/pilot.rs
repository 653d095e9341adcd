//! Pilots: many other scenes on few texels, which give the interval of the mean of a few sampled scenes.
//!
//! Losses of scenes are skewed: a few scenes see far more than the others, and a sample of nine tells nothing of them. So
//! the interval of a mean does not come from its own scenes, but from those of a pilot, which are independent of it and
//! many more: they give the distribution of the mean of N_S + N_D scenes ([`SamplingDistribution`]).
//!
//! **From quantiles to an interval.** Let q_1 and q_2 be the 2.5% and the 97.5% quantile of the mean M over scenes, and mu
//! the loss. A loss is taken to be a parameter of scale: where all differences of two materials are halved, so are, to
//! first order, the losses of all scenes and with them mu, q_1 and q_2. Then `q_1 <= M <= q_2` in 95% of the seeds, divided by
//! mu, is `M mu / q_2 <= mu <= M mu / q_1` with ratios that the pilot knows. The interval is not below 0, and an error
//! that all scenes of the pilot share, such as that of a choice of texels, cancels. A difference of losses has any sign,
//! and its expectation may be 0: it is taken to be a parameter of location, `M - (q_2 - mu) <= mu <= M - (q_1 - mu)`. So are
//! losses whose mean may come close to 0, where a ratio has no upper end. Either interval holds mu where M is between its
//! quantiles: in 95% of the seeds, whatever the shape of the distribution.
//!
//! **Units.** Random scenes are independent. Sobol scenes are dependent within a scrambling, so the distribution is that
//! of the sum over a scrambling, from as many points of other scramblings.
//!
//! **Texels.** Where the request compares an independent subset of texels per scene, so does the pilot. Where it compares
//! all, the pilot compares all its scenes on the same two random subsets A and B. Their noise makes the variance larger by
//! `var(A - B) / 4`, and values are moved to their mean until it is not. Texels that are equal in all materials have a loss of 0
//! and are left out.

use super::comparison::{Comparison, Compute};
use super::pilot_mean::{Draws, SamplingDistribution};
use super::request::Sampling;
use super::texels::{Candidates, scene_losses};
use crate::error::Error;
use crate::model::sampler::{REPLICATES, Sampler};
use crate::model::scene::Kind;
use crate::progress::Progress;

/// Single scenes of the pilot: near-field, distant.
const SCENES: [usize; 2] = [1024, 512];
/// Least scramblings of a pilot for Sobol scenes.
const SCRAMBLINGS: usize = 64;
/// A pilot of fewer degrees of freedom is made anew, this many times larger.
const FREEDOM: f64 = 60.0;
const GROWTH: usize = 8;
/// A request for more scenes, or for longer scramblings, is judged by its own: they are enough.
const MOST_SCENES: usize = 4096;
const LONGEST_SCRAMBLING: usize = 128;
/// Texels of each of two subsets that all scenes share.
const HALF: usize = 512;
/// A request for more texels per scene than these is treated as one for all.
const MOST_PER_SCENE: usize = 2048;
/// A loss is a parameter of scale where the 2.5% quantile is more than this share of the mean.
const LEAST_RATIO: f64 = 0.05;

/// The distribution of the losses of independent units, scenes or scramblings, for every prediction.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Pilot {
    groups: Vec<Group>,
    /// The distribution of the mean of each prediction.
    losses: Vec<SamplingDistribution>,
}

/// Units with the same distribution.
#[derive(Clone, Debug, PartialEq)]
struct Group {
    /// The number of them in the request.
    count: usize,
    /// For each prediction what units add to the mean.
    units: Vec<Halves>,
}

/// What units add to the mean, by two subsets of texels.
type Halves = [Vec<f64>; 2];

impl Pilot {
    /// A pilot for requests like `sampling`; `None` where that has scenes enough to be judged by them.
    ///
    /// # Errors
    /// [`Error::Cancelled`].
    pub(super) fn run<T: Compute>(
        comparison: &Comparison<'_, T>,
        sampling: &Sampling,
        progress: &Progress,
    ) -> Result<Option<Self>, Error> {
        let enough = match sampling.sampler {
            Sampler::Random => sampling.near + sampling.distant > MOST_SCENES,
            Sampler::Sobol => sampling.near.max(sampling.distant) > LONGEST_SCRAMBLING * REPLICATES,
        };
        if enough {
            return Ok(None);
        }
        let subsets = Subsets::new(comparison, sampling);
        let probe = Probe { comparison, sampling: *sampling, subsets, progress };
        let pilot = probe.pilot(1)?;
        if pilot.losses.iter().all(|loss| loss.freedom >= FREEDOM) {
            return Ok(Some(pilot));
        }
        probe.pilot(GROWTH).map(Some)
    }

    fn new(groups: Vec<Group>) -> Self {
        let mut pilot = Self { groups, losses: Vec::new() };
        let predictions = pilot.groups.first().map_or(0, |group| group.units.len());
        pilot.losses = (0..predictions).map(|p| pilot.distribution(|units| units[p].clone())).collect();
        pilot
    }

    /// The distribution of the mean of what `of` makes of the units of all predictions.
    fn distribution(&self, of: impl Fn(&[Halves]) -> Halves) -> SamplingDistribution {
        let draws = |group: &Group| Draws { values: without_noise(&of(&group.units)), count: group.count };
        SamplingDistribution::of_sum(&self.groups.iter().map(draws).collect::<Vec<_>>())
    }

    /// The 95% interval of the loss of the prediction with index `p`, whose mean over the scenes is `mean`.
    pub(super) fn interval_of_loss(&self, p: usize, mean: f64) -> [f64; 2] {
        let SamplingDistribution { mean: expected, quantiles95: [low, high], .. } = self.losses[p];
        if expected + low > LEAST_RATIO * expected {
            [high, low].map(|quantile| mean / (1.0 + quantile / expected))
        } else {
            [(mean - high).max(0.0), mean - low]
        }
    }

    /// The 95% interval of the loss with index `a` less that with index `b`, whose mean over the scenes is `mean`.
    pub(super) fn interval_of_difference(&self, a: usize, b: usize, mean: f64) -> [f64; 2] {
        let less = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a - b).collect();
        let [low, high] =
            self.distribution(|units| [0, 1].map(|half| less(&units[a][half], &units[b][half]))).quantiles95;
        [mean - high, mean - low]
    }
}

/// The means of two halves, drawn together until the noise of their texels adds nothing to the variance.
fn without_noise([a, b]: &Halves) -> Vec<f64> {
    let variance = |values: &[f64]| {
        let mean = values.iter().sum::<f64>() / values.len() as f64;
        values.iter().map(|x| (x - mean).powi(2)).sum::<f64>()
    };
    let means: Vec<f64> = a.iter().zip(b).map(|(a, b)| 0.5 * (a + b)).collect();
    let noise: Vec<f64> = a.iter().zip(b).map(|(a, b)| 0.5 * (a - b)).collect();
    let share = variance(&noise) / variance(&means);
    // NaN where all are equal.
    if share.is_nan() || share == 0.0 {
        return means;
    }
    let scale = (1.0 - share).max(0.0).sqrt();
    let mean = means.iter().sum::<f64>() / means.len() as f64;
    means.into_iter().map(|x| mean + scale * (x - mean)).collect()
}

/// What a pilot is made with.
struct Probe<'a, T> {
    comparison: &'a Comparison<'a, T>,
    sampling: Sampling,
    subsets: Subsets,
    progress: &'a Progress,
}

impl<T: Compute> Probe<'_, T> {
    /// A pilot of `size` times the usual number of scenes.
    fn pilot(&self, size: usize) -> Result<Pilot, Error> {
        let Sampling { near, distant, sampler, .. } = self.sampling;
        let total = (near + distant) as f64;
        let mut groups = Vec::new();
        for (kind, count, scenes) in [(Kind::Near, near, SCENES[0]), (Kind::Distant, distant, SCENES[1])] {
            if count == 0 {
                continue;
            }
            if sampler == Sampler::Random || count <= REPLICATES {
                let units = self.losses(kind, 0, size * scenes, Sampler::Random)?;
                groups.push(Group { count, units: sums(&units, 1, 1, total) });
                continue;
            }
            let length = count.div_ceil(REPLICATES);
            let turns = size * (scenes / length).max(SCRAMBLINGS).div_ceil(REPLICATES);
            let turn = |turn| self.losses(kind, turn, length * REPLICATES, Sampler::Sobol);
            let turns = (0..turns as u64).map(turn).collect::<Result<Vec<_>, Error>>()?;
            // The first scramblings of the request have a point more than the others.
            let long = count - REPLICATES * (length - 1);
            for (count, length) in [(long, length), (REPLICATES - long, length - 1)] {
                let turns = turns.iter().map(|losses| sums(losses, REPLICATES, length, total));
                groups.push(Group { count, units: joined(turns) });
            }
        }
        groups.retain(|group| group.count > 0);
        Ok(Pilot::new(groups))
    }

    /// For each prediction the losses of `count` Sobol scenes; `texels` samples the texels of each, where not all are
    /// compared.
    fn losses(&self, kind: Kind, turn: u64, count: usize, texels: Sampler) -> Result<Vec<Halves>, Error> {
        let seed = pilot_seed(self.sampling.seed, turn);
        let [near, distant] = if kind == Kind::Near { [count, 0] } else { [0, count] };
        let scenes = Sampler::Sobol.scenes(seed, near, distant, self.comparison.convention());
        let progress = self.progress.part();
        let shared = |texels: &Vec<usize>| {
            self.comparison.backend().scene_losses(self.comparison, &scenes, Some(texels), &progress)
        };
        let paired = |a: Vec<Vec<f64>>, b: Vec<Vec<f64>>| a.into_iter().zip(b).map(|(a, b)| [a, b]).collect();
        match &self.subsets {
            Subsets::PerScene => {
                let sampling = Sampling { near, distant, seed, sampler: texels, ..self.sampling };
                let losses = scene_losses(self.comparison, &sampling, [0, 0], &scenes, &progress)?;
                Ok(paired(losses.clone(), losses))
            }
            Subsets::Shared { halves: [first, second], share } => {
                let scaled = |values: Vec<f64>| values.into_iter().map(|x| share * x).collect();
                let a: Vec<_> = shared(first)?.into_iter().map(scaled).collect();
                let b = if first == second {
                    a.clone()
                } else {
                    shared(second)?.into_iter().map(scaled).collect()
                };
                Ok(paired(a, b))
            }
        }
    }
}

/// What units add to a mean over `total` scenes: the first `length` of every `stride`-th scene from each of the first on.
fn sums(losses: &[Halves], stride: usize, length: usize, total: f64) -> Vec<Halves> {
    let unit = |values: &[f64], first: usize| {
        values[first..].iter().step_by(stride).take(length).sum::<f64>() / total
    };
    let of_half = |values: &Vec<f64>| match stride {
        1 => values.iter().map(|value| value / total).collect(),
        _ => (0..stride).map(|first| unit(values, first)).collect(),
    };
    losses.iter().map(|halves| halves.each_ref().map(of_half)).collect()
}

/// The units of all `turns`, for each prediction.
fn joined(turns: impl Iterator<Item = Vec<Halves>>) -> Vec<Halves> {
    let join = |mut all: Vec<Halves>, turn: Vec<Halves>| {
        for (all, turn) in all.iter_mut().flatten().zip(turn.into_iter().flatten()) {
            all.extend(turn);
        }
        all
    };
    turns.reduce(join).unwrap_or_default()
}

/// Texels for the scenes of a pilot, as row * width + column.
#[derive(Debug, PartialEq)]
enum Subsets {
    /// As the request: an independent subset per scene.
    PerScene,
    /// For all scenes the same: two independent random subsets, or twice the same texels, which are all or all that
    /// differ.
    Shared {
        halves: [Vec<usize>; 2],
        /// Of all texels: those that the halves are taken from.
        share: f64,
    },
}

impl Subsets {
    fn new<T: Compute>(comparison: &Comparison<'_, T>, sampling: &Sampling) -> Self {
        let size = comparison.ground_truth().size();
        if sampling.texels.sampled(size).is_some_and(|count| count <= MOST_PER_SCENE) {
            return Self::PerScene;
        }
        let candidates = Candidates::of(comparison);
        let half = if candidates.count() <= 2 * HALF { candidates.count() } else { HALF };
        let seed = pilot_seed(sampling.seed, 0);
        let halves = [1, 2].map(|index| candidates.subset(Sampler::Random, seed, Kind::Near, index, half));
        Self::Shared { halves, share: candidates.share }
    }
}

/// The seed of the scenes and texels of a turn of a pilot, independent of those of the request.
fn pilot_seed(seed: u64, turn: u64) -> u64 {
    /// A step of a Weyl sequence, odd: the fractional part of the root of 2, times 2^64.
    const STEP: u64 = 0x6a09_e667_f3bc_c909;
    seed.wrapping_add(STEP.wrapping_mul(turn + 1))
}
