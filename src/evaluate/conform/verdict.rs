//! The verdict: whether a renderer conforms to a convention, and in which terms it differs.

use svbrdf_core::model::grammar::words::{Falloff, Rows, Sites};
use svbrdf_core::model::grammar::{Description, RendererTerms, TermDifference};

use super::fit::{Fit, Problem};
use super::search::WORTH;
use super::{Identified, alternatives};

/// Whether a renderer is the one that was asked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum VerdictKind {
    Conforms,
    Differs,
    /// It is no member of the grammar, or cannot be told.
    Unknown,
}

/// A term in which a renderer differs from the convention.
#[derive(Clone, Debug, PartialEq)]
pub struct Difference {
    pub term: TermDifference,
    /// Largest relative change of a radiance where this term alone is that of the convention.
    pub gap: f64,
}

/// What was found.
#[derive(Clone, Debug)]
pub struct Verdict {
    pub kind: VerdictKind,
    /// The renderer; the nearest one where the kind is unknown.
    pub terms: RendererTerms,
    pub differences: Vec<Difference>,
    /// RendererTerms that these points do not tell, with the values that fit as well.
    pub indistinguishable: Vec<(String, Vec<String>)>,
    /// The root mean square of the relative residuals, each at most 1.
    pub residual: f64,
    /// The points with the largest residuals in units of their limits: row, channel, relative residual.
    pub largest: Vec<(usize, usize, f64)>,
}

/// The verdict on what was identified, against the convention `asked`.
pub fn verdict(found: &Identified, asked: &Description) -> Verdict {
    let Identified { problem, fit, explained, .. } = found;
    let mut fit = fit.clone();
    if *explained {
        fit = adopted(problem, fit, &asked.terms);
    }
    let mut terms = finished(problem, &fit, &asked.terms);
    if let Some(grid) = found.grid {
        (terms.grid.sampling, terms.grid.orientation) = (grid.sampling, grid.orientation);
    }
    let differences: Vec<Difference> = terms
        .differences(&asked.terms)
        .into_iter()
        .map(|term| Difference { gap: gap(problem, &fit, &term, &asked.terms), term })
        .collect();
    let kind = match (explained, differences.is_empty()) {
        (false, _) => VerdictKind::Unknown,
        (true, true) => VerdictKind::Conforms,
        (true, false) => VerdictKind::Differs,
    };
    let mut same = if *explained { indistinguishable(problem, &fit) } else { Vec::new() };
    if found.grid.is_none() && *explained {
        let words =
            |key: &str, all: &[&str]| (key.to_owned(), all.iter().map(|word| (*word).to_owned()).collect());
        same.push(words("sampling", &Sites::ALL.map(Sites::name)));
        same.push(words("orientation", &Rows::ALL.map(Rows::name)));
    }
    Verdict {
        kind,
        terms,
        differences,
        indistinguishable: same,
        residual: residual(problem, &fit),
        largest: largest(&fit),
    }
}

/// The sections that the fit itself does not decide.
fn is_decided_elsewhere(difference: &TermDifference) -> bool {
    matches!(difference.section.as_str(), "output" | "grid")
        || matches!(difference.key.as_str(), "intensity" | "intensity_distant" | "factor" | "ambient")
}

/// The fit with the values of the convention wherever they explain the radiances as well.
fn adopted(problem: &Problem, mut fit: Fit, asked: &RendererTerms) -> Fit {
    let first = fit.clone();
    let open = |terms: &RendererTerms| {
        let differences = terms.differences(asked).into_iter();
        differences.filter(|difference| !is_decided_elsewhere(difference)).collect::<Vec<_>>()
    };
    let whole = open(&fit.terms)
        .iter()
        .fold(fit.terms, |terms, difference| terms.with(&difference.section, &difference.key, asked));
    let whole = problem.fit(&whole, fit.metallic);
    if whole.is_as_good_as(&first, WORTH) {
        return whole;
    }
    loop {
        let tried = open(&fit.terms).into_iter().map(|difference| {
            problem.fit(&fit.terms.with(&difference.section, &difference.key, asked), fit.metallic)
        });
        match tried.min_by(|a, b| a.score.total_cmp(&b.score)) {
            Some(next) if next.is_as_good_as(&first, WORTH) => fit = next,
            _ => return fit,
        }
    }
}

/// The terms with the light and the output that were seen, as the convention writes them where they are its own.
fn finished(problem: &Problem, fit: &Fit, asked: &RendererTerms) -> RendererTerms {
    let mut terms = fit.terms;
    terms.grid = asked.grid;
    terms.output = asked.output;
    terms.output.transfer = problem.observed.transfer;
    match problem.observed.clip {
        None => {}
        Some(clip) if asked.output.clip.is_some_and(|asked| close(clip, asked)) => {}
        Some(clip) => terms.output.clip = Some(clip.map(|x| rounded(x, 1e-6))),
    }
    let few = 10.0 * (problem.noise / (problem.readings() as f64).sqrt() + problem.roundoff);
    let tolerance = few.max(problem.precision_of_factor());
    terms.light.ambient = if fit.ambient > 0.0 && !near(fit.ambient, asked.light.ambient, 10.0 * tolerance) {
        rounded(fit.ambient, tolerance)
    } else if fit.ambient > 0.0 {
        asked.light.ambient
    } else {
        0.0
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
    let other = problem.fit(&fit.terms.with(&term.section, &term.key, asked), fit.metallic);
    let both = other.expected.as_flattened().iter().zip(fit.expected.as_flattened());
    let changes = both.map(|(other, own)| (other - own).abs() / other.abs().min(own.abs()).max(1e-300));
    changes.filter(|change| !change.is_nan()).fold(0.0, f64::max)
}

/// The terms whose other values fit as well.
fn indistinguishable(problem: &Problem, fit: &Fit) -> Vec<(String, Vec<String>)> {
    let fits = |terms: &RendererTerms| problem.fit(terms, fit.metallic).is_as_good_as(fit, WORTH);
    let mut found: Vec<(String, Vec<String>)> = Vec::new();
    let mut add = |terms: &RendererTerms| {
        for difference in fit.terms.differences(terms) {
            let at = found.iter().position(|(key, _)| *key == difference.key).unwrap_or_else(|| {
                found.push((difference.key.clone(), vec![difference.own.clone()]));
                found.len() - 1
            });
            if !found[at].1.contains(&difference.other) {
                found[at].1.push(difference.other);
            }
        }
    };
    for (_, terms) in alternatives::of_words(&fit.terms) {
        if fit.terms.differences(&terms).len() == 1 && fits(&terms) {
            add(&terms);
        }
    }
    for (key, set, values, _) in alternatives::of_numbers() {
        let mut terms = fit.terms;
        set(&mut terms, 1e-3);
        let is_tried = key != "lz" && values.contains(&1e-3);
        if is_tried && fit.terms.differences(&terms).len() == 1 && fits(&terms) {
            add(&terms);
        }
    }
    found
}

/// The root mean square of the relative residuals beyond the steps of storage, each at most 1, of points whose maps are in range.
fn residual(problem: &Problem, fit: &Fit) -> f64 {
    let (mut sum, mut count) = (0.0, 0);
    for (i, relative) in fit.relative.iter().enumerate().filter(|(i, _)| fit.in_range[*i]) {
        for c in (0..3).filter(|c| !relative[*c].is_nan()) {
            let step = problem.observed.readings[i][c].half / fit.expected[i][c];
            sum += (relative[c].abs() - step).clamp(0.0, 1.0).powi(2);
            count += 1;
        }
    }
    (sum / f64::from(count.max(1))).sqrt()
}

fn largest(fit: &Fit) -> Vec<(usize, usize, f64)> {
    let mut all: Vec<(usize, usize)> =
        (0..fit.residuals.len()).flat_map(|row| [0, 1, 2].map(|c| (row, c))).collect();
    all.sort_by(|a, b| fit.residuals[b.0][b.1].abs().total_cmp(&fit.residuals[a.0][a.1].abs()));
    let mut rows = std::collections::HashSet::new();
    all.retain(|(row, _)| rows.insert(*row));
    all.truncate(5);
    all.into_iter().map(|(row, c)| (row, c, fit.relative[row][c])).collect()
}
