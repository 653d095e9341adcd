//! The mean of the log differences of each texel over scenes, block by block.

use fearless_simd::{Fallback, Simd};
use rayon::prelude::*;

use super::compare::TexelLogProducts;
use super::inputs::LossInputs;
use super::pass::LossTile;
use crate::error::Error;
use crate::model::scene::Scene;
use crate::progress::Progress;
use crate::render::simd::geometry::KernelScene;
use crate::render::simd::lanes::{Lanes, Level, dispatch};
use crate::render::simd::size::{TEXELS, TEXELS_PER_BLOCK};

impl LossInputs<'_> {
    /// For each prediction the means of all texels.
    pub(super) fn texel_means(
        &self,
        level: Level,
        scenes: &[Scene],
        progress: &Progress,
    ) -> Result<Vec<Vec<[f32; 3]>>, Error> {
        let scenes = self.kernel_scenes(scenes);
        progress.begin(self.blocks as u64);
        let blocks = (0..self.blocks)
            .into_par_iter()
            .map_init(
                || LossTile::new(self.predictions.len()),
                |tile, block| {
                    let means = dispatch!(level, simd => self.block_means(simd, tile, &scenes, block));
                    progress.step()?;
                    Ok(means)
                },
            )
            .collect::<Result<Vec<_>, Error>>()?;
        let of = |prediction: usize| blocks.iter().flat_map(|means| &means[prediction]).copied().collect();
        Ok((0..self.predictions.len()).map(of).collect())
    }

    /// For each prediction the means of the texels of one block.
    #[inline(always)]
    fn block_means<S: Lanes>(
        &self,
        simd: S,
        tile: &mut LossTile,
        scenes: &[KernelScene],
        block: usize,
    ) -> Vec<Vec<[f32; 3]>> {
        let mut means = vec![Vec::with_capacity(TEXELS_PER_BLOCK); self.predictions.len()];
        let mut sums = vec![TexelLogProducts::<S>::new(simd); self.predictions.len()];
        let distant: Vec<_> = scenes.iter().map(|scene| scene.distant(simd)).collect();
        let end = self.texels.min((block + 1) * TEXELS_PER_BLOCK);
        for start in (block * TEXELS_PER_BLOCK..end).step_by(TEXELS) {
            let span = start..end.min(start + TEXELS);
            tile.fill(simd, self, &self.span(span.clone()));
            sums.fill(TexelLogProducts::new(simd));
            for (scene, distant) in scenes.iter().zip(&distant) {
                tile.add(simd, &self.params, scene, *distant, &mut sums);
            }
            for (means, sums) in means.iter_mut().zip(&sums) {
                let mean = |texel| sums.of_texel(texel).map(|sum| (sum / scenes.len() as f64) as f32);
                means.extend((0..span.len()).map(mean));
            }
        }
        means
    }
}
