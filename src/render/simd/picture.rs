//! Whole images through the kernel: the same geometry and the same radiance, without a comparison.

use fearless_simd::{Fallback, Simd};
use glam::DVec3;
use rayon::prelude::*;

use super::TEXELS_PER_BLOCK;
use super::geometry::{Rays, Source};
use super::lanes::{Lanes, Level, dispatch};
use super::shade::{Model, Radiance};
use super::tile::{self, AHEAD, At, Axes, Places, TEXELS, Terms, prefetch};
use crate::error::Error;
use crate::image::Image;
use crate::material::{Material, Planes};
use crate::model::convention::Convention;
use crate::model::scene::Scene;
use crate::progress::Progress;

/// [`crate::render::render_f32`] with a given instruction set.
///
/// # Errors
/// [`Error::UnusableScene`], [`Error::Cancelled`].
pub fn render_at(
    level: Level,
    material: &Material<f32>,
    scene: &Scene,
    convention: &Convention,
    progress: &Progress,
) -> Result<Image<f32>, Error> {
    scene.check().map_err(|problem| Error::UnusableScene { problem })?;
    let (width, height) = (material.width(), material.height());
    let mut pixels = vec![[0.0; 3]; width * height];
    let view = View::new(material, scene, convention);
    progress.begin(pixels.len().div_ceil(TEXELS_PER_BLOCK) as u64);
    pixels.par_chunks_mut(TEXELS_PER_BLOCK).enumerate().try_for_each_init(
        || Tile::ZERO,
        |tile, (block, pixels)| {
            dispatch!(level, simd => view.block(simd, tile, block * TEXELS_PER_BLOCK, pixels));
            progress.step()
        },
    )?;
    Ok(Image { width, height, pixels })
}

/// A material in a scene.
struct View<'a> {
    material: &'a Planes<f32>,
    /// The same, as a list.
    planes: Vec<&'a [f32]>,
    model: Model,
    axes: Axes,
    source: Source,
}

impl<'a> View<'a> {
    fn new(material: &'a Material<f32>, scene: &Scene, convention: &Convention) -> Self {
        let grid = material.grid();
        Self {
            material: material.planes(),
            planes: tile::planes(material.planes()).collect(),
            model: Model::without_epsilon(convention),
            axes: Axes::from(grid),
            source: Source::new(scene, convention, grid.position::<DVec3>(0, 0).length()),
        }
    }

    /// Renders the texels from `start` on into `pixels`.
    #[inline(always)]
    fn block<S: Lanes>(&self, simd: S, tile: &mut Tile, start: usize, pixels: &mut [[f32; 3]]) {
        for (i, pixels) in pixels.chunks_mut(TEXELS).enumerate() {
            let at = start + i * TEXELS;
            prefetch(simd, &self.planes, at + AHEAD);
            tile.render(simd, self, &At::Run(at..at + pixels.len()));
            tile.copy_to(pixels);
        }
    }
}

/// The texels that are in cache.
struct Tile {
    places: Places,
    rays: Rays,
    terms: Terms,
    radiance: Radiance,
}

impl Tile {
    const ZERO: Self =
        Self { places: Places::ZERO, rays: Rays::ZERO, terms: Terms::ZERO, radiance: Radiance::ZERO };

    #[inline(always)]
    fn render<S: Lanes>(&mut self, simd: S, view: &View<'_>, at: &At<'_>) {
        self.terms.fill(view.material, at, view.model.roughness_floor);
        if let Some(ray) = view.source.distant(simd) {
            self.radiance.render(
                simd,
                &view.model,
                &view.source,
                &self.terms,
                #[inline(always)]
                |_| ray,
            );
            return;
        }
        self.places.fill(&view.axes, at);
        self.rays.fill(simd, &view.source, &self.places);
        let rays = &self.rays;
        self.radiance.render(
            simd,
            &view.model,
            &view.source,
            &self.terms,
            #[inline(always)]
            |i| rays.load(simd, i),
        );
    }

    /// From planes to pixels.
    #[inline(always)]
    fn copy_to(&self, pixels: &mut [[f32; 3]]) {
        let [red, green, blue] = self.radiance.0.each_ref().map(tile::Plane::values);
        for (((pixel, r), g), b) in pixels.iter_mut().zip(red).zip(green).zip(blue) {
            *pixel = [*r, *g, *b];
        }
    }
}
