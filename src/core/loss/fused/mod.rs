//! The rendering loss in f32 with SIMD instructions: all scenes pass over one tile of texels while it is in cache.
//!
//! One source is compiled for every instruction set, and the widest one is chosen at run time. It is tested against
//! [`Plain`](super::Plain). For each tile and scene three passes follow each other: the geometry that all materials
//! share (`render::simd::geometry`), the radiance of each material (`render::simd::shade`), and the comparison of the
//! ground truth with each prediction (`compare`). The buffers between them stay in the L1 cache.
//!
//! Sums have an order. A block of tiles gives one f64 per scene and prediction, which depends on that scene and that
//! prediction only, and blocks are added in order. So neither the number of threads nor the other scenes and
//! predictions of a batch change a bit. Instruction sets differ in the last bits.

mod compare;
mod inputs;
mod pass;
mod rows;
mod sums;

use rayon::prelude::*;

use super::comparison::{Backend, Comparison, Compute, by_prediction};
use super::plain::{self, Plain};
use crate::error::Error;
use crate::model::scene::Scene;
use crate::progress::Progress;
use crate::render::simd::Level;
use inputs::LossInputs;
use pass::LossTile;
use rows::TexelRows;
use sums::SCENES_PER_GROUP;

/// The most sums held in memory at a time.
const MAX_SUMS: usize = 1 << 20;

/// The loss in f32, many times faster than [`Plain`](super::Plain), which computes it for members of the grammar.
///
/// Within a relative 1e-6 of f64 on materials with a roughness of at least 1/255. A light or a view within 1e-18 of
/// the plane is rendered as if it were that far above it; R that does not fit f32, as the largest number.
#[derive(Clone, Copy, Debug, Default)]
pub struct Fused {
    /// The instruction set. `None`: the widest one of this machine.
    pub level: Option<Level>,
}

impl Fused {
    /// For each prediction of `comparison` the mean over `scenes`, which are usable, of what each texel and channel adds to the loss.
    /// A block of texels is one step of `progress`.
    ///
    /// # Errors
    /// [`Error::Cancelled`]; [`Error::NotComputed`] where the loss is no mean over texels.
    pub fn texel_means(
        &self,
        comparison: &Comparison<'_, f32>,
        scenes: &[Scene],
        progress: &Progress,
    ) -> Result<Vec<Vec<[f32; 3]>>, Error> {
        if comparison.convention().member.is_some() {
            return plain::texel_means(comparison, scenes, progress);
        }
        let level = self.level.unwrap_or_else(Level::best);
        let inputs = LossInputs::new(comparison, None);
        inputs.texel_means(level, scenes, progress)
    }
}

impl Compute for f32 {
    fn cpu() -> &'static dyn Backend<Self> {
        &Fused { level: None }
    }
}

impl Backend<f32> for Fused {
    fn scene_losses(
        &self,
        comparison: &Comparison<'_, f32>,
        scenes: &[Scene],
        texels: Option<&[usize]>,
        progress: &Progress,
    ) -> Result<Vec<Vec<f64>>, Error> {
        let predictions = comparison.predictions();
        if predictions.is_empty() {
            return Ok(Vec::new());
        }
        if comparison.convention().member.is_some() {
            return Plain.scene_losses(comparison, scenes, texels, progress);
        }
        let level = self.level.unwrap_or_else(Level::best);
        let inputs = LossInputs::new(comparison, texels);
        let groups: usize = scenes.len().div_ceil(SCENES_PER_GROUP);
        progress.begin((groups * inputs.blocks) as u64);
        let per_batch = SCENES_PER_GROUP * (MAX_SUMS / (SCENES_PER_GROUP * inputs.blocks)).max(1);
        let mut per_scene = vec![Vec::with_capacity(scenes.len()); predictions.len()];
        for batch in scenes.chunks(per_batch) {
            inputs.append_losses(level, batch, progress, &mut per_scene)?;
        }
        Ok(per_scene)
    }

    fn losses_on_own_texels(
        &self,
        comparison: &Comparison<'_, f32>,
        scenes: &[Scene],
        texels: &(dyn Fn(usize) -> Vec<usize> + Sync),
        progress: &Progress,
    ) -> Result<Vec<Vec<f64>>, Error> {
        let (ground_truth, predictions) = (comparison.ground_truth(), comparison.predictions());
        if comparison.convention().member.is_some() {
            return Plain.losses_on_own_texels(comparison, scenes, texels, progress);
        }
        let level = self.level.unwrap_or_else(Level::best);
        progress.begin(scenes.len() as u64);
        let materials: Vec<_> = [ground_truth].into_iter().chain(predictions.iter().copied()).collect();
        let listed = match comparison.places() {
            (_, None) if !scenes.is_empty() => scenes.len() * texels(0).len(),
            // Texels that were taken from a map are side by side.
            _ => 0,
        };
        let rows = TexelRows::of(&materials, listed);
        let of_scene = |tile: &mut LossTile, (index, scene)| {
            let texels = texels(index);
            let inputs = LossInputs::new(comparison, Some(&texels));
            let inputs = LossInputs { rows: rows.as_ref(), ..inputs };
            progress.step().map(|()| inputs.losses_of_scene(level, tile, scene))
        };
        let tile = || LossTile::new(predictions.len());
        let losses = scenes.par_iter().enumerate().map_init(tile, of_scene);
        Ok(by_prediction(predictions.len(), &losses.collect::<Result<Vec<_>, _>>()?))
    }
}
