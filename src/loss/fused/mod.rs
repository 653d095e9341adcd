//! The rendering loss in f32 at the speed of the machine: all scenes pass over a few texels while these are in cache.
//!
//! One source, compiled for every instruction set and chosen at run time. [`super::losses`] is the plain twin that it
//! is tested against. For a tile of [`tile::TEXELS`] texels and each scene three passes follow each other: the
//! geometry that all materials share ([`geometry`]), the radiance of each material ([`shade`]), and the comparison of
//! the ground truth with each prediction ([`compare`]). Buffers between them stay in the nearest cache.
//!
//! Sums have an order: a block of tiles gives one f64 for each scene and prediction, which nothing else that is
//! computed influences, and blocks are added in their order. So neither the number of threads nor the other scenes
//! and predictions of a batch change a bit. Instruction sets do: they differ in the last bits.

mod compare;
mod geometry;
mod lanes;
mod shade;
mod tile;

use fearless_simd::{Fallback, Simd};
use rayon::prelude::*;

use super::{Loss, check};
use crate::convention::Convention;
use crate::error::Error;
use crate::material::Material;
use crate::progress::Progress;
use crate::scene::Scene;
use compare::LogSum;
use geometry::{Ray, Rays, Source};
pub use lanes::Level;
use lanes::{Lanes, V, dispatch};
use shade::{Model, Radiance, TAME};
use tile::{Axes, Places, TEXELS, Terms};

/// Texels whose logarithm is taken at once, and which one thread works on at a time.
const TEXELS_PER_BLOCK: usize = 16 * TEXELS;
/// Scenes that pass over a tile while it is in cache. More would push it out.
const SCENES_PER_GROUP: usize = 64;
/// Most sums that are held at a time.
const MAX_SUMS: usize = 1 << 20;

/// What [`super::losses`] computes, in f32 and many times faster, with the widest instruction set of the machine.
///
/// Within a relative 1e-6 of f64 on materials with a roughness of at least 1/255. Where a light or a view is within
/// 1e-18 of the plane, it is rendered as if it were that far above it; where R does not fit f32, as the largest number.
///
/// # Errors
/// [`Error::SizesDiffer`], [`Error::UnusableScene`], [`Error::Usage`] without scenes, [`Error::Cancelled`].
pub fn losses_f32(
    ground_truth: &Material<f32>,
    predictions: &[&Material<f32>],
    scenes: &[Scene],
    convention: &Convention,
    progress: &Progress,
) -> Result<Vec<Loss>, Error> {
    losses_at(Level::best(), ground_truth, predictions, scenes, convention, progress)
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
    check(ground_truth, predictions, scenes)?;
    if predictions.is_empty() {
        return Ok(Vec::new());
    }
    let job = Job::new(ground_truth, predictions, convention);
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

/// Everything that does not depend on the scenes.
struct Job<'a> {
    ground_truth: &'a Material<f32>,
    predictions: &'a [&'a Material<f32>],
    convention: &'a Convention,
    model: Model,
    axes: Axes,
    /// All planes of all materials.
    planes: Vec<&'a [f32]>,
    texels: usize,
    blocks: usize,
}

impl<'a> Job<'a> {
    fn new(
        ground_truth: &'a Material<f32>,
        predictions: &'a [&'a Material<f32>],
        convention: &'a Convention,
    ) -> Self {
        let texels = ground_truth.width() * ground_truth.height();
        Self {
            ground_truth,
            predictions,
            convention,
            model: Model::from(convention),
            axes: Axes::from(ground_truth.grid()),
            planes: [&ground_truth]
                .into_iter()
                .chain(predictions)
                .flat_map(|m| tile::planes(m.planes()))
                .collect(),
            texels,
            blocks: texels.div_ceil(TEXELS_PER_BLOCK),
        }
    }

    /// Appends the loss of each scene to the list of each prediction.
    fn run(
        &self,
        level: Level,
        scenes: &[Scene],
        progress: &Progress,
        per_scene: &mut [Vec<f64>],
    ) -> Result<(), Error> {
        let reach = self.ground_truth.grid().position::<f64>(0, 0).length();
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

    /// The sums of one block: for each scene, for each prediction.
    #[inline(always)]
    fn block<S: Lanes>(&self, simd: S, tile: &mut Tile, sources: &[Source], block: usize) -> Vec<f64> {
        let mut sums = vec![LogSum::<S>::new(simd); sources.len() * self.predictions.len()];
        let distant: Vec<_> = sources.iter().map(|source| source.distant(simd)).collect();
        let end = self.texels.min((block + 1) * TEXELS_PER_BLOCK);
        for start in (block * TEXELS_PER_BLOCK..end).step_by(TEXELS) {
            tile.fill(self, start..end.min(start + TEXELS));
            for (i, sums) in sums.chunks_mut(self.predictions.len()).enumerate() {
                self.prefetch(simd, start + TEXELS, i, sources.len());
                tile.add(simd, &self.model, &sources[i], distant[i], sums);
            }
        }
        sums.iter().map(LogSum::total).collect()
    }

    /// Asks for the tile at `start`, spread over `parts` calls, so that memory works while the kernel computes.
    #[inline(always)]
    fn prefetch<S: Lanes>(&self, simd: S, start: usize, part: usize, parts: usize) {
        let first = |part| part * self.planes.len() / parts;
        for plane in &self.planes[first(part)..first(part + 1)] {
            if let Some(tile) = plane.get(start..).and_then(|rest| rest.first_chunk()) {
                simd.prefetch(tile);
            }
        }
    }
}

/// The texels that are in cache.
struct Tile {
    places: Places,
    rays: Rays,
    ground_truth: Terms,
    predictions: Vec<Terms>,
    expected: Radiance,
    got: Radiance,
}

impl Tile {
    fn new(predictions: usize) -> Self {
        Self {
            places: Places::ZERO,
            rays: Rays::ZERO,
            ground_truth: Terms::ZERO,
            predictions: vec![Terms::ZERO; predictions],
            expected: Radiance::ZERO,
            got: Radiance::ZERO,
        }
    }

    #[inline(always)]
    fn fill(&mut self, job: &Job<'_>, at: std::ops::Range<usize>) {
        self.places.fill(&job.axes, at.clone());
        let floor = job.model.roughness_floor;
        self.ground_truth.fill(job.ground_truth.planes(), at.clone(), floor);
        for (terms, material) in self.predictions.iter_mut().zip(job.predictions) {
            terms.fill(material.planes(), at.clone(), floor);
        }
    }

    /// Adds the differences in one scene, whose geometry is `distant` if that is the same everywhere, to the sums of
    /// the predictions.
    #[inline(always)]
    fn add<S: Lanes>(
        &mut self,
        simd: S,
        model: &Model,
        source: &Source,
        distant: Option<Ray<V<S>>>,
        sums: &mut [LogSum<S>],
    ) {
        match distant {
            Some(ray) => self.add_rays(
                simd,
                model,
                source,
                sums,
                #[inline(always)]
                |_, _| ray,
            ),
            None => {
                self.rays.fill(simd, source, &self.places);
                self.add_rays(
                    simd,
                    model,
                    source,
                    sums,
                    #[inline(always)]
                    |rays, i| rays.load(simd, i),
                );
            }
        }
    }

    #[inline(always)]
    fn add_rays<S: Lanes>(
        &mut self,
        simd: S,
        model: &Model,
        source: &Source,
        sums: &mut [LogSum<S>],
        ray: impl Fn(&Rays, usize) -> Ray<V<S>>,
    ) {
        let rays = &self.rays;
        let (expected, got) = (&mut self.expected, &mut self.got);
        let expected_tame = shade(
            simd,
            model,
            source,
            expected,
            &self.ground_truth,
            #[inline(always)]
            |i| ray(rays, i),
        );
        for (terms, sum) in self.predictions.iter().zip(sums) {
            let got_tame = shade(
                simd,
                model,
                source,
                got,
                terms,
                #[inline(always)]
                |i| ray(rays, i),
            );
            if got_tame && expected_tame {
                sum.add::<false>(simd, expected, got);
            } else {
                sum.add::<true>(simd, expected, got);
            }
        }
    }
}

/// Renders a tile, again and carefully where that is needed; says whether it was not.
#[inline(always)]
fn shade<S: Lanes>(
    simd: S,
    model: &Model,
    source: &Source,
    radiance: &mut Radiance,
    terms: &Terms,
    ray: impl Fn(usize) -> Ray<V<S>>,
) -> bool {
    let tame = if model.clamps.any {
        radiance.fill::<S, true, false>(simd, model, terms, &ray)
    } else {
        radiance.fill::<S, false, false>(simd, model, terms, &ray)
    };
    if tame && source.most_boost <= TAME {
        return true;
    }
    if model.clamps.any {
        radiance.fill::<S, true, true>(simd, model, terms, &ray);
    } else {
        radiance.fill::<S, false, true>(simd, model, terms, &ray);
    }
    false
}
