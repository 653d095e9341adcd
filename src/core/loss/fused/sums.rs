//! The sums of a loss, and the means of its texels over scenes, block by block.

use fearless_simd::{Fallback, Simd};
use rayon::prelude::*;

use super::compare::{LogProducts, TexelLogProducts};
use super::inputs::LossInputs;
use super::pass::LossTile;
use crate::error::Error;
use crate::model::scene::Scene;
use crate::progress::Progress;
use crate::render::simd::geometry::KernelScene;
use crate::render::simd::lanes::{FLOATS_PER_LINE, Lanes, Level, dispatch};
use crate::render::simd::tile::prefetch;
use crate::render::simd::{AHEAD, TEXELS, TEXELS_PER_BLOCK};

/// Scenes that pass over a tile while it is in cache. The sums of more would evict it.
pub(super) const SCENES_PER_GROUP: usize = 64;

impl LossInputs<'_> {
    /// Appends the loss of each scene to the list of each prediction.
    pub(super) fn append_losses(
        &self,
        level: Level,
        scenes: &[Scene],
        progress: &Progress,
        per_scene: &mut [Vec<f64>],
    ) -> Result<(), Error> {
        let scenes = self.kernel_scenes(scenes);
        let groups: Vec<_> = scenes.chunks(SCENES_PER_GROUP).collect();
        let sums = (0..groups.len() * self.blocks)
            .into_par_iter()
            .map_init(
                || LossTile::new(self.predictions.len()),
                |tile, i| {
                    let (group, block) = (groups[i / self.blocks], i % self.blocks);
                    let sums = self.block_at(level, tile, group, block);
                    progress.step()?;
                    Ok(sums)
                },
            )
            .collect::<Result<Vec<_>, Error>>()?;
        let count = 3.0 * self.texels as f64;
        for (group, sums) in groups.iter().zip(sums.chunks(self.blocks)) {
            for scene in 0..group.len() {
                for (p, list) in per_scene.iter_mut().enumerate() {
                    let at = scene * self.predictions.len() + p;
                    list.push(sums.iter().map(|block| block[at]).sum::<f64>() / count);
                }
            }
        }
        Ok(())
    }

    /// For each prediction the loss of one scene; 0 where there are no texels.
    pub(super) fn losses_of_scene(&self, level: Level, tile: &mut LossTile, scene: &Scene) -> Vec<f64> {
        let scenes = self.kernel_scenes(std::slice::from_ref(scene));
        let mut losses = vec![0.0; self.predictions.len()];
        for block in 0..self.blocks {
            let sums = self.block_at(level, tile, &scenes, block);
            losses.iter_mut().zip(sums).for_each(|(loss, sum)| *loss += sum);
        }
        losses.iter_mut().for_each(|loss| *loss /= (3.0 * self.texels as f64).max(1.0));
        losses
    }

    /// The scenes as the kernel takes them.
    pub(super) fn kernel_scenes(&self, scenes: &[Scene]) -> Vec<KernelScene> {
        scenes.iter().map(|scene| KernelScene::new(scene, self.convention, self.reach)).collect()
    }

    /// The sums of one block: for each scene, for each prediction.
    fn block_at(&self, level: Level, tile: &mut LossTile, scenes: &[KernelScene], block: usize) -> Vec<f64> {
        dispatch!(level, simd => self.block(simd, tile, scenes, block))
    }

    #[inline(always)]
    fn block<S: Lanes>(
        &self,
        simd: S,
        tile: &mut LossTile,
        scenes: &[KernelScene],
        block: usize,
    ) -> Vec<f64> {
        let mut sums = vec![LogProducts::new(simd); scenes.len() * self.predictions.len()];
        let distant: Vec<_> = scenes.iter().map(|scene| scene.distant(simd)).collect();
        let end = self.texels.min((block + 1) * TEXELS_PER_BLOCK);
        self.look_up_pages(simd, end);
        for start in (block * TEXELS_PER_BLOCK..end).step_by(TEXELS) {
            tile.fill(simd, self, &self.span(start..end.min(start + TEXELS)));
            for (i, sums) in sums.chunks_mut(self.predictions.len()).enumerate() {
                self.prefetch_part(simd, start + AHEAD, i, scenes.len());
                tile.add(simd, &self.params, &scenes[i], distant[i], sums);
            }
        }
        sums.iter().map(LogProducts::total).collect()
    }

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

    /// Prefetches a part of the tile at `start`. All `parts` calls together prefetch all of it, spread over the scenes.
    #[inline(always)]
    fn prefetch_part<S: Lanes>(&self, simd: S, start: usize, part: usize, parts: usize) {
        let first = |part| part * self.planes.len() / parts;
        prefetch::<S, TEXELS>(simd, &self.planes[first(part)..first(part + 1)], start);
    }

    /// Prefetches a line of each page of the block at `start`. A processor looks up several addresses of pages at a time;
    /// left to the tiles, it would wait for one after the other.
    #[inline(always)]
    fn look_up_pages<S: Lanes>(&self, simd: S, start: usize) {
        // Two pages of 4 KiB per plane, or parts of three.
        for texel in [0, TEXELS_PER_BLOCK / 2, TEXELS_PER_BLOCK - FLOATS_PER_LINE] {
            prefetch::<S, FLOATS_PER_LINE>(simd, &self.planes, start + texel);
        }
    }
}
