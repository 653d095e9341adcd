//! Whose renderer is it: the member of the grammar that gave out radiances at known points, or that none did.
//!
//! [`identify`] searches the grammar from coarse to fine: storage, encoding, structure, then floors one after the other, with limits that
//! grow with the condition number of a point and with the noise that is seen. What does not fit within these limits has no name.

mod alternatives;
mod columns;
mod fit;
mod noise;
mod observed;
mod pictures;
mod probes;
mod rendered;
mod search;
mod verdict;

use svbrdf_core::model::grammar::words::Transfer;
use svbrdf_core::model::grammar::{GridTerms, Point, RendererTerms};

pub use fit::Fit;
use fit::{CLEARLY, Problem};
use observed::Observed;
pub use observed::Storage;
pub use probes::{Answer, probes};
pub use rendered::{ProbeMaterial, probe_materials};
pub use verdict::{Difference, Verdict, VerdictKind, verdict};

/// Unit roundoffs of the levels of the search, the coarsest first: the last two are those of float32 and float64.
const LEVELS: [f64; 4] = [1e-4, 2e-6, f32::EPSILON as f64 / 2.0, f64::EPSILON];

/// The best renderer of the grammar for an answer.
#[derive(Clone, Debug)]
pub struct Identified {
    pub problem: Problem,
    pub fit: Fit,
    pub storage: Storage,
    /// Whether what remains is within rounding, or is noise.
    pub explained: bool,
    /// The grid, where a picture tells it.
    pub grid: Option<GridTerms>,
}

/// Searches the grammar.
pub fn identify(answer: &Answer) -> Identified {
    let storage = Storage::of(answer.radiance.as_flattened());
    let workflows = match answer.metallic {
        Some(metallic) => vec![metallic],
        None => vec![false, true],
    };
    let layouts: Vec<(Option<GridTerms>, &[Point])> = match answer.grids.as_slice() {
        [] => vec![(None, &answer.points)],
        grids => grids.iter().map(|(grid, points)| (Some(*grid), points.as_slice())).collect(),
    };
    let (mut candidates, mut best_frame) = (Vec::new(), f64::INFINITY);
    for (grid, points) in layouts {
        for transfer in [Transfer::Linear, Transfer::Gamma, Transfer::Srgb] {
            let observed = Observed::new(&answer.radiance, storage, transfer);
            let problem = Problem::new(points, observed, LEVELS[0]);
            let found = search::structures(&problem, &workflows, &mut best_frame);
            candidates.extend(found.into_iter().map(|candidate| (problem.clone(), candidate, grid)));
        }
    }
    candidates.sort_by(|a, b| a.1.off.total_cmp(&b.1.off));
    let other = |grid| candidates.iter().find(|one| one.2 != grid).map_or(f64::INFINITY, |one| one.1.off);
    let is_clear = candidates.first().is_some_and(|(_, best, grid)| other(*grid) > CLEARLY * best.off);
    let mut best: Option<Identified> = None;
    for (problem, candidate, grid) in candidates.into_iter().take(4) {
        let found = from_coarse_to_fine(problem, &candidate, storage);
        if found.explained {
            let picture = answer.picture.as_ref();
            let of_picture = || picture.and_then(|picture| picture.grid(&found.problem, &found.fit));
            let grid = grid.filter(|_| is_clear).or_else(of_picture);
            return Identified { grid, ..found };
        }
        if best.as_ref().is_none_or(|best| spread(&found.fit) < spread(&best.fit)) {
            best = Some(found);
        }
    }
    best.unwrap_or_else(|| {
        let observed = Observed::new(&answer.radiance, storage, Transfer::Linear);
        let problem = Problem::new(&answer.points, observed, LEVELS[0]);
        let fit = problem.fit(&RendererTerms::BASE, workflows[0]);
        Identified { problem, fit, storage, explained: false, grid: None }
    })
}

/// The mean absolute relative residual, at most 1 each.
pub fn spread(fit: &Fit) -> f64 {
    let used = fit.relative.as_flattened().iter().filter(|x| !x.is_nan());
    let (sum, count) = used.fold((0.0, 0), |(sum, count), x| (sum + x.abs().min(1.0), count + 1));
    if count == 0 { f64::INFINITY } else { sum / f64::from(count) }
}

/// The renderer about a structure, at one level of precision after the other, until noise or rounding is all that remains.
fn from_coarse_to_fine(mut problem: Problem, start: &search::Candidate, storage: Storage) -> Identified {
    let mut start = *start;
    let mut best: Option<(Problem, Fit)> = None;
    for roundoff in LEVELS.into_iter().filter(|level| *level >= storage.roundoff()) {
        problem.roundoff = roundoff;
        problem.noise = 0.0;
        let mut fit = search::refined(&problem, &start);
        if !fit.is_explained() {
            // Without the noise, it would be taken for floors.
            problem.roundoff = storage.roundoff().max(LEVELS[2]);
            for _ in 0..3 {
                let before = problem.noise;
                problem.noise = noise::seen(&problem, &fit);
                if !noise::is_likely(&problem, &fit) || problem.noise == before {
                    break;
                }
                fit = search::refined(&problem, &start);
            }
        }
        if !fit.is_explained() && !noise::is_all_that_remains(&problem, &fit) {
            if best.is_none() {
                return Identified { problem, fit, storage, explained: false, grid: None };
            }
            break;
        }
        start.terms = fit.terms;
        let is_noisy = problem.noise > 0.0;
        best = Some((problem.clone(), fit));
        if is_noisy {
            break;
        }
    }
    let (problem, fit) = best.unwrap_or_else(|| {
        let fit = problem.fit(&start.terms, start.metallic);
        (problem, fit)
    });
    Identified { problem, fit, storage, explained: true, grid: None }
}
