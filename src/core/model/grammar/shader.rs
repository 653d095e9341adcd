//! Terms and scenes as `shaders/grammar.wgsl` takes them: plain numbers, for every program that draws.

use serde::Serialize;

use super::words::{Falloff, Rows, Sites};
use super::{GridTerms, RendererTerms};

/// A member of `Model` of the shader.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Member {
    /// A word by its place in [`super::words`], or whether something is so.
    Word(u32),
    Number(f32),
}

/// `Rays` of the shader, but for the ends of the scene.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct ShaderRays {
    pub view_is_point: bool,
    pub light_is_point: bool,
    /// With the factor.
    pub intensity: [f32; 3],
    pub falls_off: bool,
    /// The position of a texel from that in a grid of corners whose row 0 is on top.
    pub columns: [f32; 2],
    pub rows: [f32; 2],
    pub half_extent: f32,
}

/// A limit that nothing reaches.
const NONE: f64 = f32::MAX as f64;

/// The members of `Model` with their names, in order.
pub fn model(terms: &RendererTerms) -> Vec<(&'static str, Member)> {
    words(terms).into_iter().chain(numbers(terms)).collect()
}

fn words(terms: &RendererTerms) -> [(&'static str, Member); 18] {
    let RendererTerms { material: m, specular: s, diffuse, light, output, .. } = terms;
    [
        ("material", m.material as u32),
        ("clip_maps", m.clip_maps.into()),
        ("alpha", m.alpha as u32),
        ("normal", m.normal as u32),
        ("normal_y", m.normal_y as u32),
        ("flip_below", m.flip_below.into()),
        ("distribution", s.d as u32),
        ("d_xi", s.d_xi.into()),
        ("nh_clamped", s.nh_clamped.into()),
        ("shadowing", s.g as u32),
        ("k", s.k as u32),
        ("denominator", s.denominator as u32),
        ("fresnel", s.f as u32),
        ("f90", s.f90 as u32),
        ("spec_cosine", s.spec_cosine.into()),
        ("diffuse", diffuse.diffuse as u32),
        ("collocated", light.collocated.into()),
        ("transfer", output.transfer as u32),
    ]
    .map(|(name, word)| (name, Member::Word(word)))
}

fn numbers(terms: &RendererTerms) -> [(&'static str, Member); 33] {
    let RendererTerms { material: m, specular: s, light, output, .. } = terms;
    let range = |range: Option<[f64; 2]>| range.unwrap_or([-NONE, NONE]);
    let [term_low, term_high] = range(output.clip_terms);
    let [low, high] = range(output.clip);
    let [after_low, after_high] = range(output.clip_after);
    [
        ("f0", m.f0),
        ("r_min", m.r_min),
        ("r_max", m.r_max),
        ("vec_eps", m.vec_eps),
        ("d_den_min", s.d_den_min),
        ("d_add", s.d_add),
        ("d_den2_min", s.d_den2_min),
        ("d_cap", s.d_cap),
        ("nl_min", s.nl_min),
        ("nv_min", s.nv_min),
        ("nh_min", s.nh_min),
        ("vh_min", s.vh_min),
        ("dot_max", s.dot_max),
        ("k_add", s.k_add),
        ("k_min", s.k_min),
        ("g_den_min", s.g_den_min),
        ("g_add", s.g_add),
        ("v_den_min", s.v_den_min),
        ("den_add", s.den_add),
        ("front_min", s.front_min.unwrap_or(-NONE)),
        ("cos_min", light.cos_min),
        ("cos_max", light.cos_max.unwrap_or(s.dot_max)),
        ("lz", light.lz.unwrap_or(-1.0)),
        ("falloff_add", light.falloff_add),
        ("spot", light.spot),
        ("ambient", light.ambient),
        ("term_low", term_low),
        ("term_high", term_high),
        ("low", low),
        ("high", high),
        ("pre_add", output.pre_add),
        ("after_low", after_low),
        ("after_high", after_high),
    ]
    .map(|(name, number)| (name, Member::Number(number.clamp(-NONE, NONE) as f32)))
}

/// A near-field or a distant scene, for materials of `size` = [width, height].
pub fn rays(terms: &RendererTerms, is_near: bool, size: [usize; 2]) -> ShaderRays {
    let (light, grid) = (&terms.light, &terms.grid);
    let intensity =
        if is_near { light.intensity } else { light.intensity_distant.unwrap_or(light.intensity) };
    let are_points = is_near || grid.distant_is_point;
    let [columns, rows] = from_corners(grid, size);
    ShaderRays {
        view_is_point: are_points || grid.light_only_distant,
        light_is_point: are_points,
        intensity: intensity.map(|intensity| (intensity * light.factor) as f32),
        falls_off: light.falloff == Falloff::Square && are_points,
        columns,
        rows,
        half_extent: grid.half_extent as f32,
    }
}

/// What x and y of a position are multiplied by for x and for y of [`GridTerms::position`], where the position is that of a grid
/// of corners whose row 0 is on top.
fn from_corners(grid: &GridTerms, [width, _]: [usize; 2]) -> [[f32; 2]; 2] {
    let scale = match grid.sampling {
        Sites::Corner => grid.half_extent,
        Sites::Centre => grid.half_extent * (width.max(2) - 1) as f64 / width as f64,
    } as f32;
    match grid.orientation {
        Rows::Up => [[scale, 0.0], [0.0, scale]],
        Rows::Down => [[scale, 0.0], [0.0, -scale]],
        Rows::Transposed => [[0.0, -scale], [-scale, 0.0]],
    }
}
