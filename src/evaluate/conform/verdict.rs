//! The verdict: whether a renderer conforms to a convention, and in which terms it differs.

use serde::Serialize;

use svbrdf_core::model::grammar::words::Falloff;
use svbrdf_core::model::grammar::{Description, RendererTerms, TermDifference};

use super::Identified;
use super::fit::{Fit, Problem};
use super::search::WORTH;

/// Whether a renderer is that of the expected convention.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "lowercase")]
pub enum VerdictKind {
    Conforms,
    Differs,
    /// It is no member of the grammar, or the points do not decide.
    Unknown,
}

/// A term in which a renderer differs from a convention.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct TermGap {
    /// Its key in the TOML of a convention.
    pub term: String,
    /// Its value in the renderer.
    pub found: String,
    /// Its value in the convention.
    pub expected: String,
    /// Largest relative change of a radiance where this term alone is that of the convention; `None` where it changes no radiance.
    pub gap: Option<f64>,
}

/// What was found.
#[derive(Clone, Debug)]
pub struct Verdict {
    pub kind: VerdictKind,
    /// The renderer; the nearest one where the kind is unknown. What the points do not tell is as in the convention.
    pub terms: RendererTerms,
    pub differences: Vec<TermGap>,
    /// The root mean square of the relative residuals, each at most 1.
    pub residual: f64,
}

/// The verdict on what was identified, against the convention `asked`.
pub fn verdict(found: &Identified, asked: &Description) -> Verdict {
    let Identified { problem, fit, explained, .. } = found;
    let fit = if *explained { &adopted(problem, fit, &asked.terms) } else { fit };
    let terms = finished(problem, fit, &asked.terms);
    let differences: Vec<TermGap> = terms
        .differences(&asked.terms)
        .into_iter()
        .map(|term| TermGap {
            gap: Some(gap(problem, fit, &term, &asked.terms)).filter(|gap| gap.is_finite()),
            term: term.key,
            found: term.own,
            expected: term.other,
        })
        .collect();
    let kind = match (explained, differences.is_empty()) {
        (false, _) => VerdictKind::Unknown,
        (true, true) => VerdictKind::Conforms,
        (true, false) => VerdictKind::Differs,
    };
    let residual = problem.residual(fit);
    // What changes less than what remains may stand for another term.
    let is_told = |one: &TermGap| !explained || one.gap.is_none_or(|gap| gap >= residual);
    let differences = differences.into_iter().filter(is_told).collect();
    Verdict { kind, terms, differences, residual }
}

/// The sections that the fit itself does not decide.
fn is_decided_elsewhere(difference: &TermDifference) -> bool {
    matches!(difference.section.as_str(), "output" | "grid")
        || matches!(difference.key.as_str(), "intensity" | "intensity_distant" | "factor" | "ambient")
}

/// The fit with the values of the convention wherever they explain the radiances as well.
fn adopted(problem: &Problem, first: &Fit, asked: &RendererTerms) -> Fit {
    let mut fit = first.clone();
    let open = |terms: &RendererTerms| {
        let differences = terms.differences(asked).into_iter();
        differences.filter(|difference| !is_decided_elsewhere(difference)).collect::<Vec<_>>()
    };
    let with = |terms: RendererTerms, one: &TermDifference| terms.with(&one.section, &one.key, asked);
    // Terms depend on each other: few other terms come before a way of one term after the other.
    let all = open(&fit.terms);
    let keeping = |kept: Vec<usize>| {
        let others = all.iter().enumerate().filter(|(i, _)| !kept.contains(i)).map(|(_, one)| one);
        problem.fit(&others.fold(first.terms, with))
    };
    let one = (0..all.len()).map(|i| vec![i]);
    let two = (0..all.len()).flat_map(|i| (i + 1..all.len()).map(move |j| vec![i, j]));
    let mut fewest = std::iter::once(Vec::new()).chain(one).chain(two).map(keeping);
    if let Some(next) = fewest.find(|next| problem.is_as_good(next, first, WORTH)) {
        return next;
    }
    loop {
        let tried = open(&fit.terms).into_iter().map(|one| problem.fit(&with(fit.terms, &one)));
        match tried.min_by(|a, b| a.score.total_cmp(&b.score)) {
            Some(next) if problem.is_as_good(&next, first, WORTH) => fit = next,
            _ => return fit,
        }
    }
}

/// The terms with the light and the output that were seen, as the convention writes them where they are its own.
fn finished(problem: &Problem, fit: &Fit, asked: &RendererTerms) -> RendererTerms {
    let mut terms = fit.terms;
    terms.grid = asked.grid;
    terms.output = asked.output;
    terms.output.transfer = problem.transfer;
    let [low, top] = problem.clip;
    let clip = [low.max(0.0), top];
    if (low > 0.0 || top.is_finite()) && !asked.output.clip.is_some_and(|asked| close(clip, asked)) {
        terms.output.clip = Some(clip.map(|x| rounded(x, 1e-6)));
    }
    let tolerance = 10.0 * problem.roundoff;
    terms.light.ambient = match fit.ambient {
        ambient if ambient <= 0.0 => 0.0,
        ambient if near(ambient, asked.light.ambient, 10.0 * tolerance) => asked.light.ambient,
        ambient => rounded(ambient, tolerance),
    };
    (terms.light.intensity, terms.light.intensity_distant) =
        (asked.light.intensity, asked.light.intensity_distant);
    terms.light.factor = asked.light.factor;
    let ratios = [0, 1, 2].map(|c| fit.factor[c] / asked.light.intensity[c].max(1e-300));
    let mean = ratios.iter().product::<f64>().cbrt();
    if !ratios.iter().all(|ratio| near(*ratio, mean, tolerance)) {
        terms.light.intensity = fit.factor.map(|factor| rounded(factor / asked.light.factor, tolerance));
    } else if !near(mean, asked.light.factor, tolerance) {
        terms.light.factor = rounded(mean, tolerance);
    }
    // One distance alone, or directions: a falloff is part of the factor.
    if terms.light.falloff == Falloff::None && asked.light.falloff == Falloff::None {
        terms.light.falloff_add = asked.light.falloff_add;
    }
    terms
}

fn near(a: f64, b: f64, tolerance: f64) -> bool {
    (a - b).abs() <= tolerance * a.abs().max(b.abs())
}

fn close(a: [f64; 2], b: [f64; 2]) -> bool {
    // What is below the least value of the range was not seen.
    near(a[1], b[1], 1e-3) && (near(a[0], b[0], 1e-3) || a[0] == 0.0)
}

/// The number with the fewest digits within a relative tolerance.
fn rounded(number: f64, tolerance: f64) -> f64 {
    let digits = (0..16).map(|digits| format!("{number:.digits$e}").parse().unwrap_or(number));
    digits.into_iter().find(|short| near(*short, number, tolerance)).unwrap_or(number)
}

/// The largest relative change of a radiance by one term.
fn gap(problem: &Problem, fit: &Fit, term: &TermDifference, asked: &RendererTerms) -> f64 {
    if is_decided_elsewhere(term) {
        let ratio = fit.factor[0] / (asked.light.factor * asked.light.intensity[0]);
        return if term.key == "factor" || term.key == "intensity" { (ratio - 1.0).abs() } else { f64::NAN };
    }
    let other = problem.fit(&fit.terms.with(&term.section, &term.key, asked));
    let both = other.expected.as_flattened().iter().zip(fit.expected.as_flattened());
    let changes = both.map(|(other, own)| (other - own).abs() / other.abs().min(own.abs()).max(1e-300));
    changes.filter(|change| !change.is_nan()).fold(0.0, f64::max)
}
