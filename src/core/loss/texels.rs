//! A loss from a part of the texels: many scenes on few texels, without bias.
//!
//! A scene changes the loss far more than a choice of texels does. So each scene is compared on an independent random
//! subset of the texels, in which every texel is equally likely: the loss in a scene is then known without bias, and its
//! error is part of how scenes or scramblings differ. The time does not depend on the size of the maps. Where fewer than
//! half of the texels differ, subsets are taken of these: a subset of all would miss them in most scenes.

use super::comparison::{Comparison, Compute};
use super::request::Sampling;
use crate::error::Error;
use crate::material::Material;
use crate::math::real::Real;
use crate::model::sampler::Sampler;
use crate::model::scene::{Kind, Scene};
use crate::progress::Progress;

/// Texels that are looked at first, to see whether many differ.
const GLANCE: usize = 1024;

/// The texels that subsets are taken from: all of a comparison, or those on which predictions differ from their ground truth. On all others
/// the loss is 0 in every scene.
#[derive(Debug, PartialEq)]
pub(super) struct Candidates {
    /// Those that differ in any prediction, as row * width + column; at least one, whether it differs or not. `None`: all, since half of
    /// them or more seem to differ.
    few: Option<Vec<usize>>,
    size: [usize; 2],
    /// Of all texels: those that differ.
    pub share: f64,
}

impl Candidates {
    pub(super) fn of<T: Real>(comparison: &Comparison<'_, T>) -> Self {
        let size = comparison.ground_truth().size();
        let all = size[0] * size[1];
        let differ = |index: &usize| differs(comparison, *index);
        let glance = Sampler::Random.texels(0, Kind::Near, 0, GLANCE, size);
        if glance.iter().filter(|index| differ(index)).count() >= GLANCE / 2 {
            return Self { few: None, size, share: 1.0 };
        }
        let mut few: Vec<usize> = (0..all).filter(differ).collect();
        let share = few.len() as f64 / all as f64;
        if few.is_empty() {
            few.push(0);
        }
        Self { few: Some(few), size, share }
    }

    /// Their number.
    pub(super) fn count(&self) -> usize {
        self.few.as_ref().map_or(self.size[0] * self.size[1], Vec::len)
    }

    /// `count` random ones, the same for the same seed, kind and index; all where there are no more.
    pub(super) fn subset(
        &self,
        sampler: Sampler,
        seed: u64,
        kind: Kind,
        index: usize,
        count: usize,
    ) -> Vec<usize> {
        let random = |size| sampler.texels(seed, kind, index, count, size);
        match &self.few {
            Some(few) if few.len() <= count => few.clone(),
            Some(few) => random([few.len(), 1]).into_iter().map(|at| few[at]).collect(),
            None if self.count() <= count => (0..self.count()).collect(),
            None => random(self.size),
        }
    }
}

/// Whether a texel of any prediction differs from that of the ground truth.
fn differs<T: Real>(comparison: &Comparison<'_, T>, index: usize) -> bool {
    let truth = comparison.ground_truth();
    comparison.predictions().iter().any(|prediction| texel(prediction, index).ne(texel(truth, index)))
}

fn texel<T: Real>(material: &Material<T>, index: usize) -> impl Iterator<Item = T> {
    material.planes().all().map(move |plane| plane[index])
}

/// For each prediction the losses of `scenes`, which come after `before` [near-field, distant] ones of `sampling`, on
/// its texels.
///
/// # Errors
/// Those of the backend.
pub fn scene_losses<T: Compute>(
    comparison: &Comparison<'_, T>,
    sampling: &Sampling,
    before: [usize; 2],
    scenes: &[Scene],
    progress: &Progress,
) -> Result<Vec<Vec<f64>>, Error> {
    let backend = comparison.backend();
    let Some(count) = sampling.texels.sampled(comparison.ground_truth().size()) else {
        return backend.scene_losses(comparison, scenes, None, progress);
    };
    let candidates = Candidates::of(comparison);
    let places: Vec<_> = scenes.iter().zip(indices(before, scenes)).collect();
    let subset = |at: usize| {
        let (scene, index) = places[at];
        candidates.subset(sampling.sampler, sampling.seed, scene.kind, index, count)
    };
    let mut losses = backend.losses_on_own_texels(comparison, scenes, &subset, progress)?;
    losses.iter_mut().flatten().for_each(|loss| *loss *= candidates.share);
    Ok(losses)
}

/// The index of each scene within its kind, after `before` [near-field, distant] ones.
fn indices(before: [usize; 2], scenes: &[Scene]) -> impl Iterator<Item = usize> {
    let [mut near, mut distant] = before.map(|count| count..);
    scenes.iter().filter_map(move |scene| match scene.kind {
        Kind::Near => near.next(),
        Kind::Distant => distant.next(),
    })
}

/// A random subset of the texels of a comparison, the same in every scene: for searches, where scenes are compared with one another.
#[derive(Clone, Debug, PartialEq)]
pub struct SharedTexels {
    /// Texels as row * width + column.
    texels: Vec<usize>,
    /// The part of all texels that they are taken from: on the others the loss is 0.
    share: f64,
}

impl SharedTexels {
    /// `count` texels; all that matter where there are no more.
    pub fn new<T: Compute>(comparison: &Comparison<'_, T>, count: usize) -> Self {
        let candidates = Candidates::of(comparison);
        let texels = candidates.subset(Sampler::Random, 0, Kind::Near, 0, count);
        Self { texels, share: candidates.share }
    }

    /// For each prediction the loss of each scene.
    ///
    /// # Errors
    /// Those of the backend.
    pub fn losses<T: Compute>(
        &self,
        comparison: &Comparison<'_, T>,
        scenes: &[Scene],
        progress: &Progress,
    ) -> Result<Vec<Vec<f64>>, Error> {
        let mut losses = T::cpu().scene_losses(comparison, scenes, Some(&self.texels), progress)?;
        losses.iter_mut().flatten().for_each(|loss| *loss *= self.share);
        Ok(losses)
    }
}
