//! The texels that a pilot compares.

use super::comparison::{Comparison, Compute};
use super::different_texels::DifferentTexels;
use super::request::Sampling;
use crate::model::sampler::Sampler;
use crate::model::scene::Kind;

/// Texels of each half.
const HALF: usize = 512;
/// A request for more texels per scene than these is treated as one for all.
const MOST_PER_SCENE: usize = 2048;

/// Texels for the scenes of a pilot, as row * width + column.
#[derive(Debug, PartialEq)]
pub(super) enum Subsets {
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
    pub(super) fn new<T: Compute>(comparison: &Comparison<'_, T>, sampling: &Sampling) -> Self {
        let size = comparison.ground_truth().size();
        if sampling.texels.sampled(size).is_some_and(|count| count <= MOST_PER_SCENE) {
            return Self::PerScene;
        }
        let seed = pilot_seed(sampling.seed, 0);
        let random = |index, count, size| Sampler::Random.texels(seed, Kind::Near, index, count, size);
        let (texels, share) = match DifferentTexels::of(comparison) {
            Some(DifferentTexels { texels, share }) => (texels, share),
            None if size[0] * size[1] <= 2 * HALF => ((0..size[0] * size[1]).collect(), 1.0),
            None => {
                return Self::Shared { halves: [1, 2].map(|index| random(index, HALF, size)), share: 1.0 };
            }
        };
        let halves = if texels.len() <= 2 * HALF {
            [texels.clone(), texels]
        } else {
            let subset = |index| random(index, HALF, [texels.len(), 1]).into_iter().map(|at| texels[at]);
            [1, 2].map(|index| subset(index).collect())
        };
        Self::Shared { halves, share }
    }
}

/// The seed of the scenes and texels of a turn of a pilot, independent of those of the request.
pub(super) fn pilot_seed(seed: u64, turn: u64) -> u64 {
    /// A step of a Weyl sequence, odd: the fractional part of the root of 2, times 2^64.
    const STEP: u64 = 0x6a09_e667_f3bc_c909;
    seed.wrapping_add(STEP.wrapping_mul(turn + 1))
}
