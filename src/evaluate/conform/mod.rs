//! Whose renderer is it: the member of the grammar that gave out radiances at known points, or that none did.
//!
//! [`identify`] searches the structure of a renderer first, then every term from coarse to fine, with limits that grow with the
//! condition number of a point. What does not fit within these limits has no name.

mod alternatives;
mod fit;
mod points;
mod search;
mod verdict;

use svbrdf_core::model::grammar::RendererTerms;
use svbrdf_core::model::grammar::words::{Maps, Transfer, Weight};
use svbrdf_core::statistics::sort_by_number;

pub use fit::Fit;
use fit::{Problem, is_in_range};
pub use points::{RenderedPoints, probes};
pub use verdict::{TermGap, Verdict, VerdictKind, verdict};

/// Unit roundoffs of the levels of the search, the coarsest first: the last two are those of float32 and float64.
const LEVELS: [f64; 4] = [1e-4, 2e-6, f32::EPSILON as f64 / 2.0, f64::EPSILON];
/// Most structures that are searched in full.
const STRUCTURES: usize = 4;

/// The best renderer of the grammar for points with radiances.
#[derive(Clone, Debug)]
pub struct Identified {
    pub problem: Problem,
    pub fit: Fit,
    /// Whether what remains is within rounding.
    pub explained: bool,
    /// Whether the radiances are numbers of float32.
    pub is_single: bool,
}

/// Searches the grammar.
pub fn identify(answer: &RenderedPoints) -> Identified {
    let is_single = answer.radiance.as_flattened().iter().all(|x| f64::from(*x as f32) == *x || x.is_nan());
    let workflows = answer.metallic.map_or(vec![false, true], |metallic| vec![metallic]);
    let problems: Vec<Problem> = workflows
        .into_iter()
        .flat_map(|metallic| {
            Transfer::ALL.map(|transfer| Problem::new(answer, metallic, transfer, LEVELS[0]))
        })
        .collect();
    let mut structures: Vec<(f64, RendererTerms, &Problem)> = problems
        .iter()
        .flat_map(|problem| {
            search::structures(problem).into_iter().map(move |(off, terms)| (off, terms, problem))
        })
        .collect();
    sort_by_number(&mut structures, |(off, ..)| *off);
    let first = &problems[0];
    let mut best = Identified {
        fit: first.fit(&RendererTerms::BASE),
        problem: first.clone(),
        explained: false,
        is_single,
    };
    for (_, terms, problem) in structures.into_iter().take(STRUCTURES) {
        let found = from_coarse_to_fine(problem.clone(), terms, is_single);
        if found.explained {
            return found;
        }
        if found.problem.residual(&found.fit) < best.problem.residual(&best.fit) {
            best = found;
        }
    }
    best
}

/// The renderer about a structure, at one level of precision after the other, as long as rounding is all that remains.
fn from_coarse_to_fine(mut problem: Problem, mut terms: RendererTerms, is_single: bool) -> Identified {
    let mut best: Option<Identified> = None;
    for roundoff in LEVELS.into_iter().take(if is_single { 3 } else { 4 }) {
        problem.roundoff = roundoff;
        let fit = search::refined(&problem, &terms);
        let explained = problem.is_explained(&fit);
        if best.is_none() || explained {
            terms = fit.terms;
            best = Some(Identified { problem: problem.clone(), fit, explained, is_single });
        }
        if !explained {
            break;
        }
    }
    best.unwrap_or_else(|| {
        let fit = problem.fit(&terms);
        Identified { problem, fit, explained: false, is_single }
    })
}

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
