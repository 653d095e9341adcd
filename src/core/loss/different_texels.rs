//! The texels on which a prediction differs from its ground truth: on all others the loss is 0 in every scene.

use super::comparison::Comparison;
use crate::material::Material;
use crate::math::real::Real;
use crate::model::sampler::Sampler;
use crate::model::scene::Kind;

/// Texels that are looked at first, to see whether many differ.
const GLANCE: usize = 1024;

/// The texels of a comparison of which few differ.
#[derive(Debug, PartialEq)]
pub(super) struct DifferentTexels {
    /// Those that differ in any prediction, as row * width + column; at least one, whether it differs or not.
    pub texels: Vec<usize>,
    /// Of all texels: those that differ.
    pub share: f64,
}

impl DifferentTexels {
    /// `None` where half of the texels or more seem to differ.
    pub(super) fn of<T: Real>(comparison: &Comparison<'_, T>) -> Option<Self> {
        let [width, height] = comparison.ground_truth().size();
        let all = width * height;
        let differ = |index: &usize| differs(comparison, *index);
        let glance = Sampler::Random.texels(0, Kind::Near, 0, GLANCE, [width, height]);
        if glance.iter().filter(|index| differ(index)).count() >= GLANCE / 2 {
            return None;
        }
        let mut texels: Vec<usize> = (0..all).filter(differ).collect();
        let share = texels.len() as f64 / all as f64;
        if texels.is_empty() {
            texels.push(0);
        }
        Some(Self { texels, share })
    }
}

/// Whether a texel of any prediction differs from that of the ground truth.
fn differs<T: Real>(comparison: &Comparison<'_, T>, index: usize) -> bool {
    let truth = comparison.ground_truth();
    comparison.predictions().iter().any(|prediction| texel(prediction, index).ne(texel(truth, index)))
}

fn texel<T: Real>(material: &Material<T>, index: usize) -> impl Iterator<Item = T> {
    let planes = material.planes();
    let colours = planes.normal.iter().chain(&planes.diffuse).chain(&planes.specular);
    colours.chain([&planes.roughness]).map(move |plane| plane[index])
}
