//! The sums of a loss, block by block.

use fearless_simd::{Fallback, Simd};
use glam::DVec3;
use rayon::prelude::*;

use super::compare::LogSum;
use super::pass::Tile;
use crate::error::Error;
use crate::material::Material;
use crate::model::convention::Convention;
use crate::model::scene::Scene;
use crate::progress::Progress;
use crate::render::simd::TEXELS_PER_BLOCK;
use crate::render::simd::geometry::Source;
use crate::render::simd::lanes::{Lanes, Level, dispatch};
use crate::render::simd::shade::Model;
use crate::render::simd::tile::{self, AHEAD, At, Axes, TEXELS, prefetch};

/// Scenes that pass over a tile while it is in cache. More would push it out.
pub(super) const SCENES_PER_GROUP: usize = 64;

/// Everything that does not depend on the scenes.
pub(super) struct Job<'a> {
    pub(super) ground_truth: &'a Material<f32>,
    pub(super) predictions: &'a [&'a Material<f32>],
    convention: &'a Convention,
    pub(super) model: Model,
    pub(super) axes: Axes,
    /// The texels that are compared; `None`: all.
    listed: Option<&'a [usize]>,
    /// All planes of all materials, which are read from their beginnings to their ends; none where texels are listed.
    planes: Vec<&'a [f32]>,
    texels: usize,
    pub(super) blocks: usize,
}

impl<'a> Job<'a> {
    pub(super) fn new(
        ground_truth: &'a Material<f32>,
        predictions: &'a [&'a Material<f32>],
        listed: Option<&'a [usize]>,
        convention: &'a Convention,
    ) -> Self {
        let grid = ground_truth.grid();
        let texels = listed.map_or(ground_truth.width() * ground_truth.height(), <[usize]>::len);
        let planes = [&ground_truth].into_iter().chain(predictions);
        let planes = planes.flat_map(|m| tile::planes(m.planes())).filter(|_| listed.is_none());
        Self {
            ground_truth,
            predictions,
            convention,
            model: Model::from(convention),
            axes: if listed.is_none() { Axes::from(grid) } else { Axes::without_runs(grid) },
            listed,
            planes: planes.collect(),
            texels,
            blocks: texels.div_ceil(TEXELS_PER_BLOCK),
        }
    }

    /// Appends the loss of each scene to the list of each prediction.
    pub(super) fn run(
        &self,
        level: Level,
        scenes: &[Scene],
        progress: &Progress,
        per_scene: &mut [Vec<f64>],
    ) -> Result<(), Error> {
        let reach = self.ground_truth.grid().position::<DVec3>(0, 0).length();
        let sources: Vec<_> = scenes.iter().map(|s| Source::new(s, self.convention, reach)).collect();
        let groups: Vec<_> = sources.chunks(SCENES_PER_GROUP).collect();
        let sums = (0..groups.len() * self.blocks)
            .into_par_iter()
            .map_init(
                || Tile::new(self.predictions.len()),
                |tile, i| {
                    let (group, block) = (groups[i / self.blocks], i % self.blocks);
                    let sums = dispatch!(level, simd => self.block(simd, tile, group, block));
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

    /// The texels from the `range.start`-th to the `range.end`-th.
    pub(super) fn at(&self, range: std::ops::Range<usize>) -> At<'a> {
        match self.listed {
            None => At::Run(range),
            Some(texels) => At::Listed(&texels[range]),
        }
    }

    /// The sums of one block: for each scene, for each prediction.
    #[inline(always)]
    fn block<S: Lanes>(&self, simd: S, tile: &mut Tile, sources: &[Source], block: usize) -> Vec<f64> {
        let mut sums = vec![LogSum::<S>::new(simd); sources.len() * self.predictions.len()];
        let distant: Vec<_> = sources.iter().map(|source| source.distant(simd)).collect();
        let end = self.texels.min((block + 1) * TEXELS_PER_BLOCK);
        for start in (block * TEXELS_PER_BLOCK..end).step_by(TEXELS) {
            tile.fill(self, &self.at(start..end.min(start + TEXELS)));
            for (i, sums) in sums.chunks_mut(self.predictions.len()).enumerate() {
                self.prefetch_part(simd, start + AHEAD, i, sources.len());
                tile.add(simd, &self.model, &sources[i], distant[i], sums);
            }
        }
        sums.iter().map(LogSum::total).collect()
    }

    /// Asks for the tile at `start`, spread over `parts` calls, so that memory works while the kernel computes.
    #[inline(always)]
    fn prefetch_part<S: Lanes>(&self, simd: S, start: usize, part: usize, parts: usize) {
        let first = |part| part * self.planes.len() / parts;
        prefetch(simd, &self.planes[first(part)..first(part + 1)], start);
    }
}
