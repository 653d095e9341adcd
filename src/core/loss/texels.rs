//! A loss from a part of the texels: many scenes on few texels, without bias.
//!
//! A scene changes the loss far more than a choice of texels does. So each scene is compared on an independent random
//! subset of the texels, in which every texel is equally likely: the loss in a scene is then known without bias, and its
//! error is part of how scenes or scramblings differ. The time does not depend on the size of the maps. Where fewer than
//! half of the texels differ, subsets are taken of these: a subset of all would miss them in most scenes.

use super::comparison::{Comparison, Compute};
use super::different_texels::DifferentTexels;
use super::request::Sampling;
use crate::error::Error;
use crate::model::scene::{Kind, Scene};
use crate::progress::Progress;

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
    let size = comparison.ground_truth().size();
    let backend = comparison.backend();
    let Some(count) = sampling.texels.sampled(size) else {
        return backend.scene_losses(comparison, scenes, None, progress);
    };
    let different = DifferentTexels::of(comparison);
    let share = different.as_ref().map_or(1.0, |different| different.share);
    let places: Vec<_> = scenes.iter().zip(indices(before, scenes)).collect();
    let subset = |at: usize| {
        let (scene, index) = places[at];
        let texels = |size| sampling.sampler.texels(sampling.seed, scene.kind, index, count, size);
        match &different {
            None => texels(size),
            Some(DifferentTexels { texels: few, .. }) if few.len() <= count => few.clone(),
            Some(DifferentTexels { texels: few, .. }) => {
                texels([few.len(), 1]).into_iter().map(|at| few[at]).collect()
            }
        }
    };
    let mut losses = backend.losses_on_own_texels(comparison, scenes, &subset, progress)?;
    losses.iter_mut().flatten().for_each(|loss| *loss *= share);
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
