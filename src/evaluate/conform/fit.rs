//! Fit of a renderer of the grammar to what was observed.

use std::sync::OnceLock;

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
    /// Whether the maps of a point are within [0, 1].
    in_range: Vec<bool>,
    /// A radiance of usual size.
    typical: f64,
    /// n.l, n.v and n.h, which many renderers share: by how they take normals and the camera.
    cosines: [OnceLock<Vec<[f64; 3]>>; 16],
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
        let values = observed.readings.as_flattened().iter();
        let values = values.filter(|r| r.bound == Bound::Value && r.value > 0.0).map(|r| r.value);
        let typical = median(values.collect()).unwrap_or(1.0);
        let in_range = points.iter().map(is_in_range).collect();
        let (points, cosines) = (points.to_vec(), Default::default());
        Self { points, diffuse_points, observed, roundoff, noise: 0.0, in_range, typical, cosines }
    }

    /// The points as a renderer reads them.
    pub fn points(&self, metallic: bool) -> &[Point] {
        if metallic { &self.points } else { &self.diffuse_points }
    }

    /// The radiances of a renderer, without factor and ambient light.
    pub fn predicted(&self, terms: &RendererTerms, metallic: bool) -> Vec<[f64; 3]> {
        self.points(metallic).iter().map(|point| terms.radiance(point, true)).collect()
    }

    pub fn fit(&self, terms: &RendererTerms, metallic: bool) -> Fit {
        let predicted = self.predicted(terms, metallic);
        let scale = self.scale(terms, metallic, &predicted);
        let mut fit = Fit {
            terms: *terms,
            metallic,
            factor: scale.factor,
            ambient: scale.ambient,
            expected: Vec::with_capacity(predicted.len()),
            residuals: vec![[0.0; 3]; predicted.len()],
            relative: vec![[f64::NAN; 3]; predicted.len()],
            in_range: self.in_range.clone(),
            score: self.score_within(metallic, &predicted, &scale, f64::INFINITY),
        };
        for (i, predicted) in predicted.iter().enumerate() {
            let expected = self.expected(metallic, i, *predicted, &scale);
            for (c, expected) in expected.into_iter().enumerate() {
                fit.residuals[i][c] = self.residual([i, c], expected, scale.errors[i]).unwrap_or(0.0);
                let reading = self.observed.readings[i][c];
                if reading.bound == Bound::Value && expected > 0.0 {
                    fit.relative[i][c] = (reading.value - expected) / expected;
                }
            }
            fit.expected.push(expected);
        }
        fit
    }

    /// The score of the [fit](Self::fit) of a renderer with these radiances; where it is above `most`, a number above that.
    pub fn score(&self, terms: &RendererTerms, metallic: bool, predicted: &[[f64; 3]], most: f64) -> f64 {
        self.score_within(metallic, predicted, &self.scale(terms, metallic, predicted), most)
    }

    /// The sum of log(1 + residual^2): logarithms of products, since most of the time goes into them otherwise.
    fn score_within(&self, metallic: bool, predicted: &[[f64; 3]], scale: &Scale, most: f64) -> f64 {
        /// Points whose factors fit a number.
        const TOGETHER: usize = 8;
        let mut score = 0.0;
        for (block, predicted) in predicted.chunks(TOGETHER).enumerate() {
            let mut product = 1.0;
            for (i, predicted) in (block * TOGETHER..).zip(predicted) {
                let expected = self.expected(metallic, i, *predicted, scale);
                for (c, expected) in expected.into_iter().enumerate() {
                    let residual = self.residual([i, c], expected, scale.errors[i]).unwrap_or(0.0);
                    product *= 1.0 + residual * residual;
                }
            }
            score += product.ln();
            if score > most {
                break;
            }
        }
        score
    }

    /// What a renderer is expected to give out at a point.
    fn expected(&self, metallic: bool, i: usize, predicted: [f64; 3], scale: &Scale) -> [f64; 3] {
        let diffuse = self.points(metallic)[i].diffuse_of(metallic);
        let mut expected = [0.0; 3];
        for c in 0..3 {
            expected[c] = scale.factor[c] * predicted[c] + scale.ambient * diffuse[c];
        }
        expected
    }

    /// The residual at a point and channel in units of its limit; `None` where there is no value.
    fn residual(&self, [i, c]: [usize; 2], expected: f64, error: f64) -> Option<f64> {
        let reading = self.observed.readings[i][c];
        let off = reading.value - expected;
        let limit = self.limit(&reading, error, expected).max(1e-3 * self.roundoff * self.typical);
        Some(match reading.bound {
            Bound::Missing => return None,
            Bound::AtLeast if off <= 0.0 => 0.0,
            Bound::AtMost if off >= 0.0 => 0.0,
            // 0 / 0, which the code guards.
            _ if expected.is_nan() && reading.value == 0.0 => 0.0,
            _ if !off.is_finite() => FARTHEST,
            _ => (off / limit).clamp(-FARTHEST, FARTHEST),
        })
    }

    fn scale(&self, terms: &RendererTerms, metallic: bool, predicted: &[[f64; 3]]) -> Scale {
        let ambient = self.ambient(terms, metallic);
        let errors: Vec<f64> = (0..predicted.len()).map(|i| self.relative_error(terms, i)).collect();
        let factor = self.factors(predicted, &errors, metallic, ambient);
        Scale { ambient, errors, factor }
    }

    /// The relative error of a reading by rounding and storage.
    pub fn rounding(&self, fit: &Fit, row: usize, channel: usize) -> f64 {
        let reading = self.observed.readings[row][channel];
        let error = self.relative_error(&fit.terms, row);
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

    /// n.l, n.v and n.h of all points.
    fn cosines(&self, terms: &RendererTerms) -> &[[f64; 3]] {
        let material = &terms.material;
        let kinds = [
            material.normal_y == NormalY::Down,
            material.normal == Normals::Stored,
            material.flip_below,
            terms.light.collocated,
        ];
        let index = kinds.into_iter().fold(0, |index, is| 2 * index + usize::from(is));
        self.cosines[index].get_or_init(|| {
            let of = |point: &Point| {
                let (n, l, v) = vectors(terms, point);
                let h = (l + v).normalize_or(n);
                [n.dot(l), n.dot(v), n.dot(h)]
            };
            self.points.iter().map(of).collect()
        })
    }

    /// The relative rounding error of a radiance.
    fn relative_error(&self, terms: &RendererTerms, i: usize) -> f64 {
        let [nl, nv, nh] = self.cosines(terms)[i];
        let material = &terms.material;
        let r = self.points[i].roughness.clamp(material.r_min, material.r_max.max(material.r_min));
        let a = if material.alpha == Alpha::Square { r * r } else { r };
        let denominator = (nh * nh * a * a + (1.0 - nh * nh)).max(terms.specular.d_den_min).max(1e-300);
        let condition = 4.0 + 4.0 / denominator + 1.0 / nl.abs().max(1e-9) + 1.0 / nv.abs().max(1e-9);
        UNITS * self.roundoff * condition
    }

    /// Light from everywhere: what is seen where the light is behind, as a multiple of the diffuse colour.
    fn ambient(&self, terms: &RendererTerms, metallic: bool) -> f64 {
        let (points, cosines) = (self.points(metallic), self.cosines(terms));
        let mut ratios = Vec::new();
        for (i, (point, readings)) in points.iter().zip(&self.observed.readings).enumerate() {
            if cosines[i][0] < -0.02 {
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
            let mut weighted: Vec<_> = ratios.iter().map(|(ratio, limit)| (*ratio, limit.recip())).collect();
            let middle = weighted_median(&mut weighted).unwrap_or(1.0);
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

/// The value that has half of the weight below it, by selection.
fn weighted_median(mut values: &mut [(f64, f64)]) -> Option<f64> {
    let mut half = values.iter().map(|(_, weight)| weight).sum::<f64>() / 2.0;
    let mut found = None;
    while !values.is_empty() {
        let middle = values.len() / 2;
        let (below, (value, weight), above) =
            values.select_nth_unstable_by(middle, |a, b| a.0.total_cmp(&b.0));
        let (value, weight, weights) = (*value, *weight, below.iter().map(|(_, weight)| weight).sum::<f64>());
        if weights >= half && !below.is_empty() {
            values = below;
        } else {
            found = Some(value);
            if weights + weight >= half {
                break;
            }
            half -= weights + weight;
            values = above;
        }
    }
    found
}
