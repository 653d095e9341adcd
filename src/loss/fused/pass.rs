//! One scene passes over the tile that is in cache: all materials are rendered, and compared.

use super::compare::LogSum;
use super::sums::Job;
use crate::render::simd::geometry::{Ray, Rays, Source};
use crate::render::simd::lanes::{Lanes, V};
use crate::render::simd::shade::{Model, Radiance};
use crate::render::simd::tile::{At, Places, Terms};

/// The texels that are in cache.
pub(super) struct Tile {
    places: Places,
    rays: Rays,
    ground_truth: Terms,
    predictions: Vec<Terms>,
    expected: Radiance,
    got: Radiance,
}

impl Tile {
    pub(super) fn new(predictions: usize) -> Self {
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
    pub(super) fn fill(&mut self, job: &Job<'_>, at: &At<'_>) {
        self.places.fill(&job.axes, at);
        let floor = job.model.roughness_floor;
        self.ground_truth.fill(job.ground_truth.planes(), at, floor);
        for (terms, material) in self.predictions.iter_mut().zip(job.predictions) {
            terms.fill(material.planes(), at, floor);
        }
    }

    /// Adds the differences in one scene, whose geometry is `distant` if that is the same everywhere, to the sums of
    /// the predictions.
    #[inline(always)]
    pub(super) fn add<S: Lanes>(
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
        let expected_tame = expected.render(
            simd,
            model,
            source,
            &self.ground_truth,
            #[inline(always)]
            |i| ray(rays, i),
        );
        for (terms, sum) in self.predictions.iter().zip(sums) {
            let got_tame = got.render(
                simd,
                model,
                source,
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
