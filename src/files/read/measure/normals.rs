//! Measurements of normals: how many pixels look like them, and where their y points.

use rayon::prelude::*;

use svbrdf_core::math::srgb;

use crate::read::raster::Raster;

/// How far the length of a normal may be from 1 for a pixel to count as one.
const LENGTH: f64 = 0.12;
/// Below this share a tile is no normal map.
pub(crate) const NORMAL_AT_LEAST: f64 = 0.6;

/// Share of the pixels, in [0, 1], that look like a unit normal stored as (n + 1) / 2 and pointing up.
pub(crate) fn normal_score(raster: &Raster) -> f64 {
    if raster.channels.len() < 3 {
        return 0.0;
    }
    score_of(raster, |rgb| rgb.map(|c| 2.0 * c - 1.0))
}

/// As [`normal_score`], of normals stored as they are.
pub(crate) fn signed_normal_score(raster: &Raster) -> f64 {
    if raster.channels.len() < 3 { 0.0 } else { score_of(raster, |xyz| xyz) }
}

/// As [`normal_score`], of normals that were saved as colours, through the sRGB curve.
pub(crate) fn curved_normal_score(raster: &Raster) -> f64 {
    if raster.channels.len() < 3 {
        return 0.0;
    }
    score_of(raster, |rgb| rgb.map(|c| 2.0 * srgb::decode(c) - 1.0))
}

fn score_of(raster: &Raster, normal: impl Fn([f64; 3]) -> [f64; 3]) -> f64 {
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
    let mut sums = [0.0; 6];
    for row in (1..height.saturating_sub(1)).step_by(steps[1]) {
        for column in (1..width.saturating_sub(1)).step_by(steps[0]) {
            let index = row * width + column;
            let around = [index + width, index - width, index + 1, index - 1].map(slopes);
            let [Some(below), Some(above), Some(right), Some(left)] = around else { continue };
            let (a, b) = (below[0] - above[0], right[1] - left[1]);
            for (sum, term) in sums.iter_mut().zip([1.0, a, b, a * a, b * b, a * b]) {
                *sum += term;
            }
        }
    }
    let [n, a, b, aa, bb, ab] = sums;
    let variances = (n * aa - a * a) * (n * bb - b * b);
    let correlation = (n * ab - a * b) / variances.sqrt();
    (variances > 1e-12 && correlation.is_finite()).then_some(correlation)
}
