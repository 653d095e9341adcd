//! The texels that a pilot compares.

use super::comparison::{Comparison, Compute};
use super::request::Sampling;
use crate::material::Material;
use crate::math::real::Real;
use crate::model::sampler::Sampler;
use crate::model::scene::Kind;

/// Texels of each half.
const HALF: usize = 512;
/// A request for more texels per scene than these is treated as one for all.
const MOST_PER_SCENE: usize = 2048;
/// Texels that are looked at first, to see whether many differ.
const GLANCE: usize = 1024;

/// Texels for the scenes of a pilot, as row * width + column.
#[derive(Debug, PartialEq)]
pub(super) enum Subsets {
    /// As the request: an independent subset per scene.
    PerScene,
    /// For all scenes the same: two independent random subsets, or twice all texels that differ. The others are equal in
    /// all materials.
    Shared {
        halves: [Vec<usize>; 2],
        /// Of all texels: those that the halves are taken from.
        share: f64,
    },
}

impl Subsets {
    pub fn new<T: Compute>(comparison: &Comparison<'_, T>, sampling: &Sampling) -> Self {
        let size = comparison.ground_truth().size();
        if sampling.texels.sampled(size).is_some_and(|count| count <= MOST_PER_SCENE) {
            return Self::PerScene;
        }
        let all = size[0] * size[1];
        let seed = pilot_seed(sampling.seed, 0);
        let random = |index, count, size| Sampler::Random.texels(seed, Kind::Near, index, count, size);
        let differ = |index: &usize| differs(comparison, *index);
        if all > 2 * HALF && random(0, GLANCE, size).iter().filter(|t| differ(t)).count() > GLANCE / 2 {
            return Self::Shared { halves: [1, 2].map(|index| random(index, HALF, size)), share: 1.0 };
        }
        let differing: Vec<usize> = (0..all).filter(differ).collect();
        let share = differing.len() as f64 / all as f64;
        let halves = match differing.len() {
            // Any texel: its loss is 0.
            0 => [vec![0], vec![0]],
            count if count <= 2 * HALF => [differing.clone(), differing],
            count => [1, 2].map(|index| {
                let order = random(index, HALF, [count, 1]);
                order.into_iter().map(|at| differing[at]).collect()
            }),
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

/// Whether a texel of any prediction differs from that of the ground truth.
fn differs<T: Compute>(comparison: &Comparison<'_, T>, index: usize) -> bool {
    let truth = comparison.ground_truth();
    comparison.predictions().iter().any(|prediction| texel(prediction, index).ne(texel(truth, index)))
}

fn texel<T: Real>(material: &Material<T>, index: usize) -> impl Iterator<Item = T> {
    let planes = material.planes();
    let colours = planes.normal.iter().chain(&planes.diffuse).chain(&planes.specular);
    colours.chain([&planes.roughness]).map(move |plane| plane[index])
}
