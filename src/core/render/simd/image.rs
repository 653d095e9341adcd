//! Whole images from the geometry and the radiance of each tile.

use fearless_simd::{Fallback, Simd};
use glam::DVec3;
use rayon::prelude::*;

use super::geometry::{KernelScene, TileGeometry, is_short};
use super::lanes::{Lanes, Level, dispatch};
use super::shade::{ShadingParams, TileRadiance};
use super::tile::{self, GridAxes, MaterialTerms, Positions, TexelSpan, prefetch};
use super::{AHEAD, TEXELS, TEXELS_PER_BLOCK};
use crate::error::Error;
use crate::image::Image;
use crate::material::{Material, Planes};
use crate::model::convention::Convention;
use crate::model::scene::Scene;
use crate::progress::Progress;

/// [`crate::render::render_f32`] with a given instruction set, of a convention that is no member.
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
    scene.check_usable()?;
    let (width, height) = (material.width(), material.height());
    let mut pixels = vec![[0.0; 3]; width * height];
    let inputs = ImageInputs::new(material, scene, convention);
    progress.begin(pixels.len().div_ceil(TEXELS_PER_BLOCK) as u64);
    pixels.par_chunks_mut(TEXELS_PER_BLOCK).enumerate().try_for_each_init(
        || ImageTile::ZERO,
        |tile, (block, pixels)| {
            let start = block * TEXELS_PER_BLOCK;
            dispatch!(level, simd => inputs.block(simd, tile, start, pixels));
            progress.step()
        },
    )?;
    Ok(Image { width, height, pixels })
}

/// A material and a scene.
struct ImageInputs<'a> {
    material: &'a Planes<f32>,
    /// The planes of the material as a list, for prefetching.
    planes: Vec<&'a [f32]>,
    params: ShadingParams,
    axes: GridAxes,
    scene: KernelScene,
}

impl<'a> ImageInputs<'a> {
    fn new(material: &'a Material<f32>, scene: &Scene, convention: &Convention) -> Self {
        let grid = material.grid();
        Self {
            material: material.planes(),
            planes: material.planes().all().collect(),
            params: ShadingParams::without_epsilon(convention),
            axes: GridAxes::from(grid),
            scene: KernelScene::new(scene, convention, grid.position::<DVec3>(0, 0).length()),
        }
    }

    /// Renders the texels from `start` on into `pixels`.
    #[inline(always)]
    fn block<S: Lanes>(&self, simd: S, tile: &mut ImageTile, start: usize, pixels: &mut [[f32; 3]]) {
        for (i, pixels) in pixels.chunks_mut(TEXELS).enumerate() {
            let at = start + i * TEXELS;
            prefetch::<S, TEXELS>(simd, &self.planes, at + AHEAD);
            tile.render(simd, self, &TexelSpan::Range(at..at + pixels.len()));
            tile.copy_to(pixels);
        }
    }
}

/// The tile of an image that is in cache.
struct ImageTile {
    positions: Positions,
    geometry: TileGeometry,
    terms: MaterialTerms,
    radiance: TileRadiance,
}

impl ImageTile {
    const ZERO: Self = Self {
        positions: Positions::ZERO,
        geometry: TileGeometry::ZERO,
        terms: MaterialTerms::ZERO,
        radiance: TileRadiance::ZERO,
    };

    #[inline(always)]
    fn render<S: Lanes>(&mut self, simd: S, inputs: &ImageInputs<'_>, span: &TexelSpan<'_>) {
        let (params, scene) = (&inputs.params, &inputs.scene);
        self.terms.fill(simd, inputs.material, span, params.roughness_floor, params.narrow);
        if let Some(geometry) = scene.distant(simd) {
            self.radiance.render(
                simd,
                params,
                scene,
                &self.terms,
                is_short(simd, geometry.square),
                #[inline(always)]
                |_| geometry,
            );
            return;
        }
        self.positions.fill(&inputs.axes, span);
        let is_short = self.geometry.fill(simd, scene, &self.positions);
        let geometry = &self.geometry;
        self.radiance.render(
            simd,
            params,
            scene,
            &self.terms,
            is_short,
            #[inline(always)]
            |i| geometry.load(simd, i),
        );
    }

    /// Copies the radiance planes to pixels.
    #[inline(always)]
    fn copy_to(&self, pixels: &mut [[f32; 3]]) {
        let [red, green, blue] = self.radiance.0.each_ref().map(tile::TilePlane::values);
        for (((pixel, r), g), b) in pixels.iter_mut().zip(red).zip(green).zip(blue) {
            *pixel = [*r, *g, *b];
        }
    }
}
