//! Measurements of stored pixels.

use rayon::prelude::*;

use svbrdf_core::math::srgb;
use svbrdf_core::statistics::median;

use crate::read::raster::Raster;

/// How far the length of a normal may be from 1 for a pixel to count as one.
const LENGTH: f64 = 0.12;
/// Below this share a tile is no normal map.
pub(crate) const NORMAL_AT_LEAST: f64 = 0.6;

/// Share of the pixels, in [0, 1], that look like a unit normal stored as (n + 1) / 2 and pointing up.
pub(crate) fn normal_score(raster: &Raster) -> f64 {
    score_of(raster, |rgb| rgb.map(|c| 2.0 * c - 1.0))
}

/// As [`normal_score`], of normals stored as they are.
pub(crate) fn signed_normal_score(raster: &Raster) -> f64 {
    score_of(raster, |xyz| xyz)
}

/// As [`normal_score`], of normals that were saved as colours, through the sRGB curve.
pub(crate) fn curved_normal_score(raster: &Raster) -> f64 {
    score_of(raster, |rgb| rgb.map(|c| 2.0 * srgb::decode(c) - 1.0))
}

fn score_of(raster: &Raster, normal: impl Fn([f64; 3]) -> [f64; 3]) -> f64 {
    if raster.channels.len() < 3 {
        return 0.0;
    }
    let is_normal = |index: &usize| {
        let [x, y, z] = normal(raster.rgb(*index));
        z > 0.0 && ((x * x + y * y + z * z).sqrt() - 1.0).abs() < LENGTH
    };
    let count = raster.sampled().count();
    raster.sampled().filter(is_normal).count() as f64 / count.max(1) as f64
}

/// Correlation of d/dv (-nx/nz) with d/du (ny/nz), u to the right and v down: near 1 where green points up, near -1
/// where it points down. `None` for a flat map, and one of fewer than 3 rows or columns.
///
/// `normal` is the vector at an index, y as stored.
pub(crate) fn curl(width: usize, height: usize, normal: impl Fn(usize) -> [f64; 3] + Sync) -> Option<f64> {
    const MOST: usize = 256;
    // Odd, so that a pattern that repeats after a power of two is seen whole.
    let steps = [width, height].map(|side| (side / MOST).max(1) | 1);
    let slopes = |index: usize| {
        let [x, y, z] = normal(index);
        (z > 0.1).then(|| [-x / z, y / z])
    };
    // Where every texel is looked at, it is so from four sides.
    let all: Vec<_> =
        if steps == [1, 1] { (0..width * height).into_par_iter().map(&slopes).collect() } else { Vec::new() };
    let slopes = |index: usize| all.get(index).copied().unwrap_or_else(|| slopes(index));
    let mut correlation = Correlation::default();
    for row in (1..height.saturating_sub(1)).step_by(steps[1]) {
        for column in (1..width.saturating_sub(1)).step_by(steps[0]) {
            let index = row * width + column;
            let around = [index + width, index - width, index + 1, index - 1].map(slopes);
            let [Some(below), Some(above), Some(right), Some(left)] = around else { continue };
            correlation.add(below[0] - above[0], right[1] - left[1]);
        }
    }
    correlation.value()
}

#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Correlation {
    sums: [f64; 6],
}

impl Correlation {
    pub(crate) fn add(&mut self, a: f64, b: f64) {
        if a.is_finite() && b.is_finite() {
            self.sums.iter_mut().zip([1.0, a, b, a * a, b * b, a * b]).for_each(|(sum, term)| *sum += term);
        }
    }

    /// `None` where one of the two is constant.
    pub(crate) fn value(&self) -> Option<f64> {
        let [n, a, b, aa, bb, ab] = self.sums;
        let variances = (n * aa - a * a) * (n * bb - b * b);
        let correlation = (n * ab - a * b) / variances.sqrt();
        (variances > 1e-12 && correlation.is_finite()).then_some(correlation)
    }
}

/// Median over pixels of the least of red, green and blue: 0.04 in a specular map of dielectrics.
pub(crate) fn specular_median(raster: &Raster) -> f64 {
    let least = |index| raster.rgb(index).into_iter().fold(f64::INFINITY, f64::min);
    let mut values: Vec<f64> = raster.sampled().map(least).collect();
    median(&mut values).unwrap_or_default()
}

/// Channels of a gray picture differ by no more: compression and rounding.
const NOISE: f64 = 12.0 / 255.0;
/// Share of the texels whose channels must differ by more.
const DIFFERENT: f64 = 0.02;
/// A constant channel varies by no more.
const CONSTANT: f64 = 2.0 / 255.0;

/// The maps in the channels of a picture that is named after a gray map.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Channels {
    /// The same, but for noise.
    Gray,
    /// Green roughness and blue metallic, as glTF packs them.
    RoughnessMetallic,
    /// Green roughness; red and blue are constant.
    Roughness,
    /// Blue metallic; red and green are constant.
    Metallic,
}

impl Channels {
    /// By the constancy and the differences of the channels.
    pub(crate) fn of(raster: &Raster) -> Self {
        if raster.channels.len() < 3 || !differ(raster) {
            return Self::Gray;
        }
        let [_, green, blue] = [0, 1, 2].map(|channel| is_constant(raster, channel));
        match (green, blue) {
            (false, false) => Self::RoughnessMetallic,
            (false, true) => Self::Roughness,
            (true, false) => Self::Metallic,
            (true, true) => Self::Gray,
        }
    }
}

fn differ(raster: &Raster) -> bool {
    let is_coloured = |index: &usize| {
        let [r, g, b] = raster.rgb(*index);
        r.max(g).max(b) - r.min(g).min(b) > NOISE
    };
    let (count, different) = (raster.sampled().count(), raster.sampled().filter(is_coloured).count());
    different as f64 > DIFFERENT * count as f64
}

/// Whether channel number `channel` is the same everywhere.
pub(crate) fn is_constant(raster: &Raster, channel: usize) -> bool {
    let values = raster.sampled().map(|index| raster.rgb(index)[channel]);
    let (low, high) = values.fold((f64::MAX, f64::MIN), |(low, high), v| (low.min(v), high.max(v)));
    high - low <= CONSTANT
}

pub(crate) fn is_flat(raster: &Raster) -> bool {
    (0..3).all(|channel| is_constant(raster, channel))
}
