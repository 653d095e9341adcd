//! Noise: what differs from channel to channel, and whether it is all that remains.

use svbrdf_core::model::grammar::Point;

use super::fit::{Fit, Problem, median, vectors};
use super::observed::Bound;

/// From standard deviations of a normal distribution to medians of absolute values.
const SIGMA: f64 = 1.482_6;
/// Largest relative noise that a renderer is named at.
const MOST: f64 = 0.2;
/// Residuals above this many standard deviations are no noise.
const FAR: f64 = 6.0;
/// Largest t statistic of a mean residual over part of the points.
const MOST_T: f64 = 5.0;

/// The relative noise: the spread of the differences between the channels of a point, where a geometry that is wrong cancels.
pub fn seen(problem: &Problem, fit: &Fit) -> f64 {
    let mut differences = Vec::new();
    for (i, relative) in fit.relative.iter().enumerate() {
        for [a, b] in [[0, 1], [1, 2], [2, 0]] {
            let limits = [a, b].map(|c| problem.rounding(fit, i, c));
            let excess = (relative[a] - relative[b]).abs() - limits[0].hypot(limits[1]);
            if excess.is_finite() {
                differences.push(excess.max(0.0));
            }
        }
    }
    (SIGMA / 2.0_f64.sqrt() * median(differences).unwrap_or(0.0)).min(MOST)
}

/// Whether most residuals are as small as the noise, so that there may be nothing else but a few floors.
pub fn is_likely(problem: &Problem, fit: &Fit) -> bool {
    let relative = fit.relative.as_flattened().iter().map(|x| x.abs()).collect();
    let rounding = 100.0 * problem.roundoff;
    problem.noise > 0.0 && median(relative).is_some_and(|middle| middle < 2.0 * (problem.noise + rounding))
}

/// Whether the residuals are independent noise: as large as noise between channels, as large in their means over channels as that allows,
/// and without a trend in any variable.
pub fn is_all_that_remains(problem: &Problem, fit: &Fit) -> bool {
    if problem.noise <= 0.0 || problem.noise >= MOST {
        return false;
    }
    let mut rows: Vec<(Point, [f64; 3])> = Vec::new();
    let mut far = 0;
    for (i, point) in problem.points(fit.metallic).iter().enumerate() {
        let readings = &problem.observed.readings[i];
        let is_precise =
            |c: usize| readings[c].bound == Bound::Value && problem.rounding(fit, i, c) < 0.3 * problem.noise;
        let z = [0, 1, 2].map(|c| fit.residuals[i][c]);
        far += z.iter().filter(|z| z.abs() > FAR).count();
        if (0..3).all(is_precise) {
            rows.push((*point, z.map(|z| z.clamp(-FAR, FAR))));
        }
    }
    if rows.len() < 40 || far * 200 > 3 * fit.residuals.len() {
        return false;
    }
    let n = rows.len() as f64;
    let all = rows.iter().flat_map(|(_, z)| z).map(|z| z * z).sum::<f64>() / (3.0 * n);
    let means: Vec<f64> = rows.iter().map(|(_, z)| z.iter().sum::<f64>() / 3.0_f64.sqrt()).collect();
    let common = means.iter().map(|z| z * z).sum::<f64>() / n;
    // Of n points, the variance is known to sqrt(2 / n).
    let slack = 5.0 * (2.0 / n).sqrt();
    if all > 1.25 + slack / 3.0_f64.sqrt() || common > 1.0 + slack || common > all * (1.0 + slack) {
        return false;
    }
    let scale = all.sqrt();
    (0..FEATURES).all(|feature| {
        let values: Vec<f64> = rows.iter().map(|(point, _)| features(fit, point)[feature]).collect();
        t_of_trend(&values, &means, scale).abs() < MOST_T
    })
}

const FEATURES: usize = 10;

/// Variables that a renderer outside of the grammar may depend on in another way.
fn features(fit: &Fit, point: &Point) -> [f64; FEATURES] {
    let (n, l, v) = vectors(&fit.terms, point);
    let h = (l + v).normalize_or(n);
    let (nl, nv, nh, vh, r) = (n.dot(l), n.dot(v), n.dot(h), v.dot(h), point.roughness);
    let strong = point.specular.iter().sum::<f64>();
    let is_diffuse = f64::from(point.diffuse.iter().sum::<f64>() > 0.0);
    [nl, nv, nl * nv, vh, r, r * vh, nh, strong, is_diffuse, is_diffuse * r * vh]
}

/// The t statistic of the slope of residuals over a variable.
fn t_of_trend(x: &[f64], z: &[f64], scale: f64) -> f64 {
    let n = x.len() as f64;
    let (mean_x, mean_z) = (x.iter().sum::<f64>() / n, z.iter().sum::<f64>() / n);
    let sxx = x.iter().map(|x| (x - mean_x).powi(2)).sum::<f64>();
    let sxz = x.iter().zip(z).map(|(x, z)| (x - mean_x) * (z - mean_z)).sum::<f64>();
    if sxx <= 1e-12 { 0.0 } else { sxz / sxx.sqrt() / scale }
}
