//! Factors on the lobes of a renderer: a diffuse one without 1/pi, a specular one without 1/4.

use svbrdf_core::model::grammar::RendererTerms;
use svbrdf_core::model::grammar::words::{Maps, Weight};

use super::fit::{Problem, is_in_range};
use super::points::RenderedPoints;

/// The relative error of a radiance that is left where both factors are right.
const LEFT: f64 = 1e-4;

/// The factors on the diffuse and the specular lobe of a renderer under which it gives all radiances, by least squares of relative errors
/// (one factor for all channels); `None` where there are none.
pub fn lobe_factors(answer: &RenderedPoints, terms: &RendererTerms) -> Option<[f64; 2]> {
    let is_metallic = terms.material.material == Maps::Metallic;
    let problem = Problem::new(answer, is_metallic, terms.output.transfer, LEFT);
    let mut specular = *terms;
    specular.diffuse.diffuse = Weight::Zero;
    let (all, specular) = (problem.predicted(terms), problem.predicted(&specular));
    let mut rows: Vec<[f64; 2]> = Vec::new();
    for (i, _) in problem.points.iter().enumerate().filter(|(_, point)| is_in_range(point)) {
        for (c, value) in problem.values[i].into_iter().enumerate().filter(|(_, value)| *value > 0.0) {
            let lobes = [(all[i][c] - specular[i][c]) / value, specular[i][c] / value];
            if problem.is_value(value) && lobes.iter().all(|lobe| lobe.is_finite()) {
                rows.push(lobes);
            }
        }
    }
    let sum = |of: fn(&[f64; 2]) -> f64| rows.iter().map(of).sum::<f64>();
    let (dd, ds, ss) = (sum(|[d, _]| d * d), sum(|[d, s]| d * s), sum(|[_, s]| s * s));
    let (d, s) = (sum(|[d, _]| *d), sum(|[_, s]| *s));
    let determinant = dd * ss - ds * ds;
    let factors = [(d * ss - s * ds) / determinant, (s * dd - d * ds) / determinant];
    let off = |[d, s]: &[f64; 2]| (factors[0] * d + factors[1] * s - 1.0).abs();
    let is_right = factors.iter().all(|factor| *factor > 0.0) && rows.iter().all(|row| off(row) <= LEFT);
    (determinant > 0.0 && is_right).then_some(factors)
}
