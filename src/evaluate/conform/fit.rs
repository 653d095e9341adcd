//! Fit of a renderer of the grammar to what was observed.

use glam::DVec3;

use svbrdf_core::model::grammar::words::{Alpha, NormalY, Normals, Transfer};
use svbrdf_core::model::grammar::{Point, RendererTerms};

use super::points::RenderedPoints;

/// Largest residual that counts in full, in limits.
const FARTHEST: f64 = 1e6;
/// Rounding errors of a radiance are within this many units, times its condition number.
const UNITS: f64 = 4.0;
/// Equal largest or least values from which on they are clipped.
const EQUAL: usize = 12;

/// Points with the radiances that were observed at them, under an assumed workflow and encoding.
#[derive(Clone, Debug)]
pub struct Problem {
    /// The points as a renderer of the workflow reads them: where it is not metallic, base colours are the diffuse ones.
    pub points: Vec<Point>,
    pub metallic: bool,
    pub transfer: Transfer,
    /// Radiances in linear units; NaN where they are not finite.
    pub values: Vec<[f64; 3]>,
    /// The range that radiances are clipped to, infinite where they are not.
    pub clip: [f64; 2],
    /// Unit roundoff of the arithmetic.
    pub roundoff: f64,
    /// A radiance of usual size.
    typical: f64,
}

/// What a residual depends on beside the prediction.
struct Scale {
    ambient: f64,
    /// Relative rounding errors.
    errors: Vec<f64>,
    factor: [f64; 3],
}

/// A renderer, and how it fits.
#[derive(Clone, Debug)]
pub struct Fit {
    pub terms: RendererTerms,
    /// Factor on each channel.
    pub factor: [f64; 3],
    pub ambient: f64,
    /// The predictions.
    pub expected: Vec<[f64; 3]>,
    /// Residuals in units of their limits.
    residuals: Vec<[f64; 3]>,
    /// The sum of log(1 + residual^2).
    pub score: f64,
}

impl Problem {
    pub fn new(answer: &RenderedPoints, metallic: bool, transfer: Transfer, roundoff: f64) -> Self {
        let base = |point: &Point| if metallic { point.base_color } else { point.diffuse };
        let points = answer.points.iter().map(|point| Point { base_color: base(point), ..*point }).collect();
        let finite = || answer.radiance.as_flattened().iter().copied().filter(|x| x.is_finite());
        let clipped = |end: f64| end > 0.0 && finite().filter(|x| *x == end).count() >= EQUAL;
        let [low, top] = [finite().fold(f64::INFINITY, f64::min), finite().fold(f64::NEG_INFINITY, f64::max)];
        let clip = [
            if clipped(low) { decoded(transfer, low) } else { f64::NEG_INFINITY },
            if clipped(top) { decoded(transfer, top) } else { f64::INFINITY },
        ];
        let value = |x: f64| if x.is_finite() { decoded(transfer, x) } else { f64::NAN };
        let values = answer.radiance.iter().map(|rgb| rgb.map(value)).collect();
        let mut problem = Self { points, metallic, transfer, values, clip, roundoff, typical: 1.0 };
        let seen = problem.values.as_flattened().iter().copied().filter(|x| *x > 0.0 && problem.is_value(*x));
        problem.typical = median(seen.collect()).unwrap_or(1.0);
        problem
    }

    /// Whether a radiance is known, and not clipped.
    pub fn is_value(&self, x: f64) -> bool {
        self.clip[0] < x && x < self.clip[1]
    }

    /// The radiances of a renderer, without factor and ambient light.
    pub fn predicted(&self, terms: &RendererTerms) -> Vec<[f64; 3]> {
        self.points.iter().map(|point| terms.radiance(point, true)).collect()
    }

    pub fn fit(&self, terms: &RendererTerms) -> Fit {
        let predicted = self.predicted(terms);
        let Scale { ambient, errors, factor } = self.scale(terms, &predicted);
        let rows = self.points.iter().zip(&predicted);
        let expected: Vec<[f64; 3]> = rows
            .map(|(point, predicted)| {
                let diffuse = self.diffuse(point);
                [0, 1, 2].map(|c| factor[c] * predicted[c] + ambient * diffuse[c])
            })
            .collect();
        let residual =
            |i: usize| [0, 1, 2].map(|c| self.residual_at(self.values[i][c], expected[i][c], errors[i]));
        let residuals: Vec<[f64; 3]> = (0..expected.len()).map(residual).collect();
        // Logarithms of products, since most of the time goes into them otherwise.
        let product = |residuals: &[[f64; 3]]| {
            residuals.as_flattened().iter().map(|residual| 1.0 + residual * residual).product::<f64>()
        };
        let score = residuals.chunks(8).map(|residuals| product(residuals).ln()).sum();
        Fit { terms: *terms, factor, ambient, expected, residuals, score }
    }

    /// A residual in units of its limit; 0 where there is no value.
    fn residual_at(&self, value: f64, expected: f64, error: f64) -> f64 {
        let off = value - expected;
        let is_beyond = value >= self.clip[1] && off <= 0.0 || value <= self.clip[0] && off >= 0.0;
        // 0 / 0, which the code guards.
        let is_guarded = expected.is_nan() && value == 0.0;
        if value.is_nan() || is_beyond || is_guarded {
            return 0.0;
        }
        let limit = (error * expected.abs()).max(1e-3 * self.roundoff * self.typical);
        if off.is_finite() { (off / limit).clamp(-FARTHEST, FARTHEST) } else { FARTHEST }
    }

    fn scale(&self, terms: &RendererTerms, predicted: &[[f64; 3]]) -> Scale {
        let vectors: Vec<_> = self.points.iter().map(|point| vectors(terms, point)).collect();
        let ambient = self.ambient(&vectors);
        let errors: Vec<f64> = self
            .points
            .iter()
            .zip(&vectors)
            .map(|(point, v)| self.relative_error(terms, point, *v))
            .collect();
        let factor = self.factors(predicted, &errors, ambient);
        Scale { ambient, errors, factor }
    }

    /// The relative rounding error of a radiance.
    fn relative_error(&self, terms: &RendererTerms, point: &Point, (n, l, v): (DVec3, DVec3, DVec3)) -> f64 {
        let [nl, nv, nh] = [n.dot(l), n.dot(v), n.dot((l + v).normalize_or(n))];
        let material = &terms.material;
        let r = point.roughness.clamp(material.r_min, material.r_max.max(material.r_min));
        let a = if material.alpha == Alpha::Square { r * r } else { r };
        let denominator = (nh * nh * a * a + (1.0 - nh * nh)).max(terms.specular.d_den_min).max(1e-300);
        let condition = 4.0 + 4.0 / denominator + 1.0 / nl.abs().max(1e-9) + 1.0 / nv.abs().max(1e-9);
        UNITS * self.roundoff * condition
    }

    /// The diffuse colour that a renderer of the workflow reads.
    pub fn diffuse(&self, point: &Point) -> [f64; 3] {
        if self.metallic { point.base_color } else { point.diffuse }
    }

    /// Light from everywhere: what is seen where the light is behind, as a multiple of the diffuse colour.
    fn ambient(&self, vectors: &[(DVec3, DVec3, DVec3)]) -> f64 {
        let mut ratios = Vec::new();
        for (i, (n, l, _)) in vectors.iter().enumerate() {
            if n.dot(*l) < -0.02 {
                let of_channels = self.values[i].into_iter().zip(self.diffuse(&self.points[i]));
                ratios.extend(of_channels.filter(|(x, d)| self.is_value(*x) && *d > 0.0).map(|(x, d)| x / d));
            }
        }
        let Some(middle) = median(ratios.clone()) else { return 0.0 };
        let spread = median(ratios.iter().map(|ratio| (ratio - middle).abs()).collect()).unwrap_or(0.0);
        if ratios.len() >= 3 && middle > 0.0 && spread < 0.05 * middle { middle } else { 0.0 }
    }

    /// The factor of each channel: the weighted median of the ratios, then the mean of those that are within a few limits of it.
    fn factors(&self, predicted: &[[f64; 3]], errors: &[f64], ambient: f64) -> [f64; 3] {
        [0, 1, 2].map(|c| {
            let mut ratios = Vec::with_capacity(predicted.len());
            for (i, point) in self.points.iter().enumerate() {
                let (value, predicted) =
                    (self.values[i][c] - ambient * self.diffuse(point)[c], predicted[i][c]);
                let is_used = self.is_value(self.values[i][c]) && value > 0.0 && predicted > 0.0;
                if is_used && predicted.is_finite() {
                    ratios.push((value / predicted, errors[i]));
                }
            }
            ratios.sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
            let mut half = ratios.iter().map(|(_, limit)| limit.recip()).sum::<f64>() / 2.0;
            let is_middle = |(_, limit): &&(f64, f64)| {
                half -= limit.recip();
                half <= 0.0
            };
            let middle = ratios.iter().find(is_middle).map_or(1.0, |(ratio, _)| *ratio);
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

    /// Whether a fit explains what `other` explains, and its score is at most so much worse.
    pub fn is_as_good(&self, fit: &Fit, other: &Fit, worse: f64) -> bool {
        fit.score < other.score + worse && (self.is_explained(fit) || !self.is_explained(other))
    }

    /// Whether no residual of a point whose maps are within [0, 1] is above its limit.
    pub fn is_explained(&self, fit: &Fit) -> bool {
        let mut rows = self.points.iter().zip(&fit.residuals);
        rows.all(|(point, rgb)| !is_in_range(point) || rgb.iter().all(|residual| residual.abs() <= 1.0))
    }

    /// The root mean square of the residuals, relative to the radiances (those far below a usual one aside) and at most 1 each, of points
    /// whose maps are within [0, 1].
    pub fn residual(&self, fit: &Fit) -> f64 {
        let (mut sum, mut count) = (0.0, 0);
        for (i, _) in self.points.iter().enumerate().filter(|(_, point)| is_in_range(point)) {
            for (value, expected) in self.values[i].into_iter().zip(fit.expected[i]) {
                if self.is_value(value) && expected > 0.0 {
                    let relative = (value - expected) / expected.max(1e-9 * self.typical);
                    sum += relative.clamp(-1.0, 1.0).powi(2);
                    count += 1;
                }
            }
        }
        if count == 0 { f64::INFINITY } else { (sum / f64::from(count)).sqrt() }
    }
}

impl Fit {
    /// Whether no residual is above its limit.
    pub fn is_perfect(&self) -> bool {
        self.residuals.as_flattened().iter().all(|residual| residual.abs() <= 1.0)
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

/// Whether the maps of a point are within [0, 1].
pub fn is_in_range(point: &Point) -> bool {
    let colours = [point.diffuse, point.specular, point.base_color];
    let mut values = colours.as_flattened().iter().chain([&point.roughness, &point.metallic]);
    values.all(|x| (0.0..=1.0).contains(x))
}

/// The middle of some numbers.
pub fn median(mut values: Vec<f64>) -> Option<f64> {
    values.retain(|x| !x.is_nan());
    let middle = values.len() / 2;
    (!values.is_empty()).then(|| *values.select_nth_unstable_by(middle, f64::total_cmp).1)
}

fn decoded(transfer: Transfer, x: f64) -> f64 {
    match transfer {
        Transfer::Linear => x,
        Transfer::Gamma => x.max(0.0).powf(2.2),
        Transfer::Srgb if x <= 0.040_45 => x / 12.92,
        Transfer::Srgb => ((x + 0.055) / 1.055).powf(2.4),
    }
}
