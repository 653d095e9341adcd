//! The rendering loss in f32 at the speed of the machine: all scenes pass over a few texels while these are in cache.
//!
//! One source, compiled for every instruction set and chosen at run time. [`super::losses`] is the plain twin that it
//! is tested against. For a tile of `tile::TEXELS` texels and each scene three passes follow each other: the
//! geometry that all materials share (`geometry`), the radiance of each material (`shade`), and the comparison of
//! the ground truth with each prediction (`compare`). Buffers between them stay in the nearest cache. Whole images
//! (`picture`) come from the first two passes.
//!
//! Sums have an order: a block of tiles gives one f64 for each scene and prediction, which nothing else that is
//! computed influences, and blocks are added in their order. So neither the number of threads nor the other scenes
//! and predictions of a batch change a bit. Instruction sets do: they differ in the last bits.

mod compare;
mod pass;
mod sums;

use super::{Loss, check};
use crate::error::Error;
use crate::material::Material;
use crate::model::convention::Convention;
use crate::model::scene::Scene;
use crate::progress::Progress;
use crate::render::simd::Level;
use crate::render::simd::TEXELS_PER_BLOCK;
use sums::{Job, SCENES_PER_GROUP};

/// Most sums that are held at a time.
const MAX_SUMS: usize = 1 << 20;

/// What [`super::losses`] computes, in f32 and many times faster, with the widest instruction set of the machine.
///
/// Within a relative 1e-6 of f64 on materials with a roughness of at least 1/255. Where a light or a view is within
/// 1e-18 of the plane, it is rendered as if it were that far above it; where R does not fit f32, as the largest number.
///
/// # Errors
/// [`Error::SizesDiffer`], [`Error::UnusableScene`], [`Error::InvalidRequest`] without scenes, [`Error::Cancelled`].
pub fn losses_f32(
    ground_truth: &Material<f32>,
    predictions: &[&Material<f32>],
    scenes: &[Scene],
    convention: &Convention,
    progress: &Progress,
) -> Result<Vec<Loss>, Error> {
    losses_of_f32(ground_truth, predictions, None, scenes, convention, progress)
}

/// [`losses_f32`] over some texels only, as [`super::losses_of`].
///
/// # Errors
/// As [`losses_f32`].
///
/// # Panics
/// Where there is no such texel, as indexing a slice does.
pub fn losses_of_f32(
    ground_truth: &Material<f32>,
    predictions: &[&Material<f32>],
    texels: Option<&[usize]>,
    scenes: &[Scene],
    convention: &Convention,
    progress: &Progress,
) -> Result<Vec<Loss>, Error> {
    losses_of_at(Level::best(), ground_truth, predictions, texels, scenes, convention, progress)
}

/// [`losses_f32`] with a given instruction set.
///
/// # Errors
/// As [`losses_f32`].
pub fn losses_at(
    level: Level,
    ground_truth: &Material<f32>,
    predictions: &[&Material<f32>],
    scenes: &[Scene],
    convention: &Convention,
    progress: &Progress,
) -> Result<Vec<Loss>, Error> {
    losses_of_at(level, ground_truth, predictions, None, scenes, convention, progress)
}

/// [`losses_of_f32`] with a given instruction set.
///
/// # Errors
/// As [`losses_f32`].
///
/// # Panics
/// As [`losses_of_f32`].
pub fn losses_of_at(
    level: Level,
    ground_truth: &Material<f32>,
    predictions: &[&Material<f32>],
    texels: Option<&[usize]>,
    scenes: &[Scene],
    convention: &Convention,
    progress: &Progress,
) -> Result<Vec<Loss>, Error> {
    check(ground_truth, predictions, scenes)?;
    if predictions.is_empty() {
        return Ok(Vec::new());
    }
    let job = Job::new(ground_truth, predictions, texels, convention);
    let groups: usize = scenes.len().div_ceil(SCENES_PER_GROUP);
    progress.begin((groups * job.blocks) as u64);
    let per_batch = SCENES_PER_GROUP * (MAX_SUMS / (SCENES_PER_GROUP * job.blocks)).max(1);
    let mut per_scene = vec![Vec::with_capacity(scenes.len()); predictions.len()];
    for batch in scenes.chunks(per_batch) {
        job.run(level, batch, progress, &mut per_scene)?;
    }
    let losses = predictions.iter().zip(per_scene);
    Ok(losses.map(|(prediction, per_scene)| Loss::new(prediction.name(), scenes, per_scene)).collect())
}
