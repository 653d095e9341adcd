//! How well a renderer of the grammar explains what was observed.

use glam::DVec3;

use svbrdf_core::model::grammar::words::{Alpha, Maps, NormalY, Normals};
use svbrdf_core::model::grammar::{Point, RendererTerms};

use super::observed::{Bound, Observed, Reading};

/// Largest residual that counts in full, in limits.
const FARTHEST: f64 = 1e6;
/// Rounding errors of a radiance are within this many units, times its condition number.
const UNITS: f64 = 4.0;
/// The share of half a step by which a value may be off: a factor is fitted to rounded values, too.
const SLACK: f64 = 1.1;

/// How much better than all others a grid has to fit.
pub const CLEARLY: f64 = 3.0;

/// Points with what was observed at them.
#[derive(Clone, Debug)]
pub struct Problem {
    /// The points, where base colours are those of the file.
    points: Vec<Point>,
    /// The same, where base colours are the diffuse ones.
    diffuse_points: Vec<Point>,
    pub observed: Observed,
    /// Unit roundoff of the arithmetic.
    pub roundoff: f64,
    /// Relative noise.
    pub noise: f64,
}

/// A renderer, and how it fits.
#[derive(Clone, Debug)]
pub struct Fit {
    pub terms: RendererTerms,
    /// Whether the maps of the metallic workflow are read.
    pub metallic: bool,
    /// Factor on each channel.
    pub factor: [f64; 3],
    pub ambient: f64,
    /// The predictions.
    pub expected: Vec<[f64; 3]>,
    /// Residuals in units of their limits.
    pub residuals: Vec<[f64; 3]>,
    /// Residuals relative to the prediction; NaN where that is not above 0, or a value is none.
    pub relative: Vec<[f64; 3]>,
    /// Whether the maps of a point are within [0, 1].
    pub in_range: Vec<bool>,
    /// The sum of log(1 + residual^2).
    pub score: f64,
}

impl Problem {
    pub fn new(points: &[Point], observed: Observed, roundoff: f64) -> Self {
        let diffuse_points = points.iter().map(|p| Point { base_color: p.diffuse, ..*p }).collect();
        Self { points: points.to_vec(), diffuse_points, observed, roundoff, noise: 0.0 }
    }

    /// The points as a renderer reads them.
    pub fn points(&self, metallic: bool) -> &[Point] {
        if metallic { &self.points } else { &self.diffuse_points }
    }

    pub fn fit(&self, terms: &RendererTerms, metallic: bool) -> Fit {
        let points = self.points(metallic);
        let ambient = self.ambient(terms, points);
        let predicted: Vec<[f64; 3]> = points.iter().map(|point| terms.radiance(point, true)).collect();
        let errors: Vec<f64> = points.iter().map(|point| self.relative_error(terms, point)).collect();
        let factor = self.factors(&predicted, &errors, metallic, ambient);
        let mut fit = Fit {
            terms: *terms,
            metallic,
            factor,
            ambient,
            expected: Vec::with_capacity(points.len()),
            residuals: Vec::with_capacity(points.len()),
            relative: Vec::with_capacity(points.len()),
            in_range: points.iter().map(is_in_range).collect(),
            score: 0.0,
        };
        let least = 1e-3 * self.roundoff * self.typical();
        for (i, point) in points.iter().enumerate() {
            let (mut residuals, mut relatives) = ([0.0; 3], [f64::NAN; 3]);
            let diffuse = point.diffuse_of(metallic);
            let expected = [0, 1, 2].map(|c| factor[c] * predicted[i][c] + ambient * diffuse[c]);
            for c in 0..3 {
                let (reading, expected) = (self.observed.readings[i][c], expected[c]);
                if reading.bound == Bound::Missing {
                    continue;
                }
                let off = reading.value - expected;
                let limit = self.limit(&reading, errors[i], expected).max(least);
                residuals[c] = match reading.bound {
                    Bound::AtLeast if off <= 0.0 => 0.0,
                    Bound::AtMost if off >= 0.0 => 0.0,
                    // 0 / 0, which the code guards.
                    _ if expected.is_nan() && reading.value == 0.0 => 0.0,
                    _ if !off.is_finite() => FARTHEST,
                    _ => (off / limit).clamp(-FARTHEST, FARTHEST),
                };
                if reading.bound == Bound::Value && expected > 0.0 {
                    relatives[c] = off / expected;
                }
                fit.score += residuals[c].powi(2).ln_1p();
            }
            fit.expected.push(expected);
            fit.residuals.push(residuals);
            fit.relative.push(relatives);
        }
        fit
    }

    /// The relative error of a reading by rounding and storage.
    pub fn rounding(&self, fit: &Fit, row: usize, channel: usize) -> f64 {
        let reading = self.observed.readings[row][channel];
        let error = self.relative_error(&fit.terms, &self.points(fit.metallic)[row]);
        error + if reading.value > 0.0 { reading.half / reading.value } else { 1.0 }
    }

    /// The number of values.
    pub fn readings(&self) -> usize {
        self.observed.readings.as_flattened().iter().filter(|r| r.bound == Bound::Value).count().max(1)
    }

    /// The relative error of a fitted factor by storage: that of the most precise values.
    pub fn precision_of_factor(&self) -> f64 {
        let values = self.observed.readings.as_flattened().iter();
        let mut steps: Vec<f64> =
            values.filter(|r| r.bound == Bound::Value && r.value > 0.0).map(|r| r.half / r.value).collect();
        steps.sort_by(f64::total_cmp);
        steps.get(steps.len() / 4).copied().unwrap_or(0.0)
    }

    /// A radiance of usual size.
    fn typical(&self) -> f64 {
        let values =
            self.observed.readings.as_flattened().iter().filter(|r| r.bound == Bound::Value && r.value > 0.0);
        median(values.map(|r| r.value).collect()).unwrap_or(1.0)
    }

    /// The relative rounding error of a radiance.
    fn relative_error(&self, terms: &RendererTerms, point: &Point) -> f64 {
        let (n, l, v) = vectors(terms, point);
        let h = (l + v).normalize_or(n);
        let (nl, nv, nh) = (n.dot(l).abs(), n.dot(v).abs(), n.dot(h));
        let r = point.roughness.clamp(terms.material.r_min, terms.material.r_max.max(terms.material.r_min));
        let a = if terms.material.alpha == Alpha::Square { r * r } else { r };
        let denominator = (nh * nh * a * a + (1.0 - nh * nh)).max(terms.specular.d_den_min).max(1e-300);
        let condition = 4.0 + 4.0 / denominator + 1.0 / nl.max(1e-9) + 1.0 / nv.max(1e-9);
        UNITS * self.roundoff * condition
    }

    /// Light from everywhere: what is seen where the light is behind, as a multiple of the diffuse colour.
    fn ambient(&self, terms: &RendererTerms, points: &[Point]) -> f64 {
        let mut ratios = Vec::new();
        for (point, readings) in points.iter().zip(&self.observed.readings) {
            let (n, l, _) = vectors(terms, point);
            if n.dot(l) < -0.02 {
                let diffuse =
                    if terms.material.material == Maps::Diffuse { point.diffuse } else { point.base_color };
                let used = readings
                    .iter()
                    .zip(diffuse)
                    .filter(|(r, d)| r.bound == Bound::Value && *d > 0.0 && r.value >= 4.0 * r.half);
                ratios.extend(used.map(|(r, d)| r.value / d));
            }
        }
        let Some(middle) = median(ratios.clone()) else { return 0.0 };
        let spread = median(ratios.iter().map(|ratio| (ratio - middle).abs()).collect()).unwrap_or(0.0);
        if ratios.len() >= 3 && middle > 0.0 && spread < 0.05 * middle { middle } else { 0.0 }
    }

    /// The limit of a residual: half the step of storage, rounding and noise.
    fn limit(&self, reading: &Reading, error: f64, expected: f64) -> f64 {
        SLACK * reading.half + (error + self.noise) * expected.abs()
    }

    /// The factor of each channel: the weighted median of the ratios, then the mean of those that are within a few limits of it.
    fn factors(&self, predicted: &[[f64; 3]], errors: &[f64], metallic: bool, ambient: f64) -> [f64; 3] {
        [0, 1, 2].map(|c| {
            let mut ratios = Vec::with_capacity(predicted.len());
            for (i, point) in self.points(metallic).iter().enumerate() {
                let reading = &self.observed.readings[i][c];
                let (value, predicted) =
                    (reading.value - ambient * point.diffuse_of(metallic)[c], predicted[i][c]);
                let is_used = reading.bound == Bound::Value && value > 0.0 && predicted > 0.0;
                if is_used && predicted.is_finite() {
                    ratios.push((value / predicted, self.limit(reading, errors[i], value) / value));
                }
            }
            let middle =
                weighted_median(ratios.iter().map(|(ratio, limit)| (*ratio, limit.recip())).collect());
            let middle = middle.unwrap_or(1.0);
            let (mut sum, mut weights) = (0.0, 0.0);
            for (ratio, limit) in ratios {
                let off = ratio / middle - 1.0;
                if off.abs() <= 3.0 * limit {
                    sum += off / (limit * limit);
                    weights += 1.0 / (limit * limit);
                }
            }
            if weights > 0.0 { middle * (1.0 + sum / weights) } else { middle }
        })
    }
}

impl Fit {
    /// Whether no residual is above its limit.
    pub fn is_perfect(&self) -> bool {
        self.residuals.as_flattened().iter().all(|residual| residual.abs() <= 1.0)
    }

    /// Whether it explains what `other` explains, and its score is at most so much worse.
    pub fn is_as_good_as(&self, other: &Self, worse: f64) -> bool {
        self.score < other.score + worse && (self.is_explained() || !other.is_explained())
    }

    /// Whether no residual of a point whose maps are in range is above its limit.
    pub fn is_explained(&self) -> bool {
        let used = self.residuals.iter().zip(&self.in_range).filter(|(_, in_range)| **in_range);
        used.flat_map(|(residuals, _)| residuals).all(|residual| residual.abs() <= 1.0)
    }
}

/// Unit normal, light and view as the terms take them.
pub fn vectors(terms: &RendererTerms, point: &Point) -> (DVec3, DVec3, DVec3) {
    let mut n = DVec3::from(point.normal);
    if terms.material.normal_y == NormalY::Down {
        n.y = -n.y;
    }
    if terms.material.normal != Normals::Stored {
        n = n.normalize_or(DVec3::Z);
    }
    if terms.material.flip_below && n.z < 0.0 {
        n = -n;
    }
    let l = DVec3::from(point.light).normalize_or(DVec3::Z);
    let v = if terms.light.collocated { l } else { DVec3::from(point.view).normalize_or(DVec3::Z) };
    (n, l, v)
}

fn is_in_range(point: &Point) -> bool {
    let colours = [point.diffuse, point.specular, point.base_color];
    let mut values = colours.as_flattened().iter().chain([&point.roughness, &point.metallic]);
    values.all(|x| (0.0..=1.0).contains(x))
}

/// The diffuse colour that a renderer reads.
trait DiffuseOf {
    fn diffuse_of(&self, metallic: bool) -> [f64; 3];
}

impl DiffuseOf for Point {
    fn diffuse_of(&self, metallic: bool) -> [f64; 3] {
        if metallic { self.base_color } else { self.diffuse }
    }
}

/// The middle of some numbers.
pub fn median(mut values: Vec<f64>) -> Option<f64> {
    values.retain(|x| !x.is_nan());
    let middle = values.len() / 2;
    (!values.is_empty()).then(|| *values.select_nth_unstable_by(middle, f64::total_cmp).1)
}

/// The value that has half of the weight below it.
fn weighted_median(mut values: Vec<(f64, f64)>) -> Option<f64> {
    values.sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
    let half = values.iter().map(|(_, weight)| weight).sum::<f64>() / 2.0;
    let mut below = 0.0;
    values.into_iter().find_map(|(value, weight)| {
        below += weight;
        (below >= half).then_some(value)
    })
}
