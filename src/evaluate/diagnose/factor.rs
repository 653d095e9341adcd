//! The factor on a map of a prediction under which it is closest to that of the ground truth.

use svbrdf_core::material::Material;
use svbrdf_core::statistics::sort_by_number;

/// Most texels that a factor is fitted to.
const TEXELS: usize = 4096;

/// The factors f on diffuse and on specular with the least sum of |g - f p| over texels and channels of a ground truth and a prediction.
pub(super) fn best_factors(
    [truth, prediction]: [&Material<f32>; 2],
    is_inside: impl Fn(&usize) -> bool,
) -> [f64; 2] {
    let count = truth.width() * truth.height();
    let texels: Vec<usize> = (0..count).filter(is_inside).collect();
    // Odd, so that it has no factor in common with the width of usual maps.
    let stride = (texels.len() / TEXELS).max(1) | 1;
    let of = |map: fn(&Material<f32>) -> &[Vec<f32>; 3]| {
        let channels = || map(truth).iter().zip(map(prediction));
        let pairs = texels.iter().step_by(stride).flat_map(|&texel| {
            channels().map(move |(truth, prediction)| [truth[texel], prediction[texel]].map(f64::from))
        });
        weighted_median(pairs.filter(|[_, p]| *p > 0.0).map(|[g, p]| (g / p, p)).collect())
    };
    [of(|material| &material.planes().diffuse), of(|material| &material.planes().specular)]
}

/// The median of numbers with weights; 1 without any, or where it is 0.
fn weighted_median(mut all: Vec<(f64, f64)>) -> f64 {
    sort_by_number(&mut all, |(number, _)| *number);
    let half = 0.5 * all.iter().map(|(_, weight)| weight).sum::<f64>();
    let mut sum = 0.0;
    let middle = all.iter().find(|(_, weight)| {
        sum += weight;
        sum >= half
    });
    middle.map(|(number, _)| *number).filter(|number| *number > 0.0).unwrap_or(1.0)
}
