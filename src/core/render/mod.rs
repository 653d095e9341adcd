//! Algorithm 3 over a whole material, on the CPU.
//!
//! ```
//! use svbrdf_core::material::Material;
//! use svbrdf_core::model::brdf::Texel;
//! use svbrdf_core::model::convention::PRINTED;
//! use svbrdf_core::model::scene::{Kind, Scene};
//! use svbrdf_core::progress::Progress;
//! use svbrdf_core::render;
//!
//! let texel = Texel { normal: glam::Vec3::Z, diffuse: [0.5; 3], specular: [0.04; 3], roughness: 0.6 };
//! let material = Material::uniform("gray", 64, 64, &texel)?;
//! let scene = Scene { kind: Kind::Near, view: [0.0, 0.0, 2.5], light: [0.4, 0.5, 1.2] };
//! let image = render::render_f32(&material, &scene, &PRINTED, &Progress::default())?;
//! assert_eq!((image.width, image.height), (64, 64));
//! # Ok::<(), svbrdf_core::error::Error>(())
//! ```

pub mod simd;

use glam::DVec3;
use rayon::prelude::*;

use crate::error::Error;
use crate::image::Image;
use crate::material::{Grid, Material, base_and_metallic};
use crate::math::real::{Real, Vector as _};
use crate::model::brdf::{self, Model, Texel};
use crate::model::convention::Convention;
use crate::model::grammar::words::Maps;
use crate::model::grammar::{Factors, Point, RendererTerms};
use crate::model::scene::{Kind, Rays, Scene};
use crate::model::terms::Terms;
use crate::progress::Progress;

/// Renders every texel of `material` under `scene`, in parallel by rows.
///
/// # Errors
/// [`Error::UnusableScene`] where [`Scene::check`] refuses the scene, [`Error::Cancelled`].
pub fn render<T: Real>(
    material: &Material<T>,
    scene: &Scene,
    convention: &Convention,
    progress: &Progress,
) -> Result<Image<T>, Error> {
    scene.check_usable()?;
    let model = Model::from(convention);
    let rays = scene.rays();
    let (width, height) = (material.width(), material.height());
    let mut pixels = vec![[T::zero(); 3]; width * height];
    progress.begin(height as u64);
    pixels.par_chunks_mut(width).enumerate().try_for_each(|(row, pixels)| {
        for (column, pixel) in pixels.iter_mut().enumerate() {
            *pixel = render_texel(material, &model, &rays, column, row);
        }
        progress.step()
    })?;
    Ok(Image { width, height, pixels })
}

/// What [`render`] computes, in f32 and many times faster, with the widest instruction set of the machine; a member of the grammar as
/// [`render`] does.
///
/// Within the rounding of a handful of f32 operations, and the same bits for any number of threads. Where R does not
/// fit f32, it is 2^126.
///
/// # Errors
/// As [`render`].
pub fn render_f32(
    material: &Material<f32>,
    scene: &Scene,
    convention: &Convention,
    progress: &Progress,
) -> Result<Image<f32>, Error> {
    if convention.member.is_some() {
        return render(material, scene, convention, progress);
    }
    simd::render_at(simd::Level::best(), material, scene, convention, progress)
}

/// A texel in f64, exactly.
pub fn widened<T: Real>(texel: &Texel<T>) -> Texel<f64> {
    Texel {
        normal: texel.normal.cast(),
        diffuse: texel.diffuse.map(T::f64),
        specular: texel.specular.map(T::f64),
        roughness: texel.roughness.f64(),
    }
}

/// A texel of a grid as the terms of the grammar take it.
fn member_point<T: Real>(
    terms: &RendererTerms,
    texel: &Texel<f64>,
    grid: Grid,
    rays: &Rays<T>,
    [column, row]: [usize; 2],
) -> Point {
    let Texel { normal, diffuse, specular, roughness } = *texel;
    let (base_color, metallic) = match terms.material.material {
        Maps::Metallic => base_and_metallic(diffuse, specular),
        Maps::Diffuse | Maps::Dielectric => (diffuse, 0.0),
    };
    let [light, view] = rays.ends().map(|end| end.cast::<DVec3>());
    let at = terms.grid.position(column, row, grid.width, grid.height);
    let (light, view) = terms.grid.vectors(at, light, view, rays.kind() == Kind::Near);
    let [normal, light, view] = [normal, light, view].map(|vector| vector.to_array());
    Point { normal, diffuse, specular, roughness, base_color, metallic, light, view }
}

/// The radiance of a texel by the terms of the grammar; 0 where they divide 0 by 0, and the largest number where they divide by 0.
#[cold]
fn member_radiance<T: Real>(
    terms: &RendererTerms,
    texel: &Texel<T>,
    grid: Grid,
    rays: &Rays<T>,
    place: [usize; 2],
) -> [f64; 3] {
    let point = member_point(terms, &widened(texel), grid, rays, place);
    let radiance = terms.radiance(&point, rays.kind() == Kind::Near);
    radiance.map(|x| if x.is_nan() { 0.0 } else { x.min(f64::MAX) })
}

/// The terms of the texel in column `column` of row `row` of a grid.
pub fn texel_terms(
    texel: &Texel<f64>,
    grid: Grid,
    model: &Model<f64>,
    rays: &Rays<f64>,
    [column, row]: [usize; 2],
) -> Terms<f64> {
    let Some(member) = model.member else {
        let (w_l, w_v) = rays.from_texel(grid.position(column, row));
        return Terms::of(model, texel, w_l, w_v);
    };
    let point = member_point(&member.terms, texel, grid, rays, [column, row]);
    let Factors { cosines: [n_dot_l, n_dot_v, n_dot_h, v_dot_h], d, g, f } = member.terms.factors(&point);
    let radiance = member_radiance(&member.terms, texel, grid, rays, [column, row]);
    Terms { n_dot_l, n_dot_v, n_dot_h, v_dot_h, d, g, f, radiance }
}

/// Renders the texel in column `column` of row `row`.
#[inline]
pub fn render_texel<T: Real>(
    material: &Material<T>,
    model: &Model<T>,
    rays: &Rays<T>,
    column: usize,
    row: usize,
) -> [T; 3] {
    let place = row * material.width() + column;
    render_sample(&material.texel(place), model, rays, material.grid(), place)
}

/// Renders a texel at a place of a grid, as row * width + column.
#[inline]
pub fn render_sample<T: Real>(
    texel: &Texel<T>,
    model: &Model<T>,
    rays: &Rays<T>,
    grid: Grid,
    place: usize,
) -> [T; 3] {
    radiance(texel, model, rays, grid, place).map(|x| T::of(x).min(T::max_value()))
}

/// As [`render_sample`]: Algorithm 3 in the precision `T`, a member of the grammar in f64.
#[inline]
pub fn radiance<T: Real>(
    texel: &Texel<T>,
    model: &Model<T>,
    rays: &Rays<T>,
    grid: Grid,
    place: usize,
) -> [f64; 3] {
    let [column, row] = [place % grid.width, place / grid.width];
    if let Some(member) = model.member {
        return member_radiance(&member.terms, texel, grid, rays, [column, row]);
    }
    let (w_l, w_v) = rays.from_texel(grid.position(column, row));
    brdf::render(model, texel, w_l, w_v).map(T::f64)
}
