//! The search of the grammar: first its structure, at points that no floor reaches, then everything at all points.

use rayon::prelude::*;

use svbrdf_core::model::grammar::words::{
    Alpha, Denominator, Distribution, Falloff, Fresnel, K, Maps, NormalY, Shadowing, Weight,
};
use svbrdf_core::model::grammar::{Point, RendererTerms};

use super::alternatives::{self, SHADOWINGS, SPOTS};
use super::fit::{Fit, Problem, median, vectors};
use super::observed::Bound;

/// Largest absolute logarithm that counts in full.
const FARTHEST: f64 = 1.0;
/// Improvement of the score that a further number has to make.
pub const WORTH: f64 = 14.0;
/// The share of the score that a further change has to improve: one that is needed improves more, and what is no member goes on for
/// long by less.
const LITTLE: f64 = 0.005;
/// Most changes of one term after the other.
const MOST_STEPS: usize = 16;

/// A renderer, with the workflow whose maps it reads, and its mean absolute log ratio.
#[derive(Clone, Copy, Debug)]
pub struct Candidate {
    pub terms: RendererTerms,
    pub metallic: bool,
    pub off: f64,
}

/// The points that no usual floor reaches.
struct Plain {
    metallic: bool,
    points: Vec<Point>,
    /// For each channel the points with a value, its logarithm, and its weight by precision.
    values: [Vec<(usize, f64, f64)>; 3],
}

impl Plain {
    fn new(problem: &Problem, metallic: bool) -> Self {
        let mut plain = Self { metallic, points: Vec::new(), values: Default::default() };
        let ambient = problem.fit(&RendererTerms::BASE, metallic).ambient;
        for (point, readings) in problem.points(metallic).iter().zip(&problem.observed.readings) {
            // Either direction of y.
            let is_plain = [NormalY::Up, NormalY::Down].into_iter().all(|y| {
                let mut terms = RendererTerms::BASE;
                terms.material.normal_y = y;
                let (n, l, v) = vectors(&terms, point);
                n.dot(l) > 0.1 && n.dot(v) > 0.1 && l.z > 0.1
            });
            let in_range = |c: [f64; 3]| c.iter().all(|x| (0.0..=1.0).contains(x));
            let length = glam::DVec3::from(point.normal).length();
            let is_rough = (0.2..=1.0).contains(&point.roughness);
            let is_unit = (length - 1.0).abs() <= 1e-3;
            let is_in_range =
                in_range(point.diffuse) && in_range(point.specular) && in_range(point.base_color);
            if !(is_plain && is_rough && is_unit && is_in_range) {
                continue;
            }
            for (c, reading) in readings.iter().enumerate() {
                let diffuse = if metallic { point.base_color } else { point.diffuse };
                let value = reading.value - ambient * diffuse[c];
                if reading.bound == Bound::Value && value > 2.0 * reading.half {
                    let weight = 1.0 / (1.0 + 100.0 * reading.half / value);
                    plain.values[c].push((plain.points.len(), value.ln(), weight));
                }
            }
            plain.points.push(*point);
        }
        plain
    }

    fn radiances(&self, terms: &RendererTerms) -> Vec<[f64; 3]> {
        self.points.iter().map(|point| terms.radiance(point, true)).collect()
    }

    /// The mean absolute log ratio to radiances of these logarithms, with the best factor for each channel; at every n-th value.
    fn off(&self, every: usize, log_of: impl Fn(usize, usize) -> f64) -> f64 {
        let (mut sum, mut weights) = (0.0, 1e-9);
        for (c, values) in self.values.iter().enumerate() {
            let mut ratios = Vec::with_capacity(values.len());
            for (i, log, weight) in values.iter().step_by(every) {
                ratios.push((log - log_of(*i, c), *weight));
            }
            let Some(middle) = median(ratios.iter().map(|(log, _)| *log).collect()) else { continue };
            for (log, weight) in ratios {
                sum += weight * (log - middle).abs().min(FARTHEST);
                weights += weight;
            }
        }
        sum / weights
    }
}

/// The logarithm of a radiance.
fn log(radiance: f64) -> f64 {
    radiance.max(1e-12).ln()
}

/// What is decided first: whose maps, the frame and the light, each with its log ratio. The light is a factor of all that is seen.
fn frames(plain: &Plain) -> Vec<(f64, RendererTerms)> {
    let maps = if plain.metallic { Maps::Metallic } else { Maps::Diffuse };
    let mut geometries = Vec::new();
    for material in [maps, Maps::Dielectric] {
        for normal_y in NormalY::ALL {
            for collocated in [false, true] {
                let mut terms = RendererTerms::BASE;
                (terms.material.material, terms.material.normal_y) = (material, normal_y);
                terms.diffuse.diffuse = alternatives::weights(material)[0];
                terms.light.collocated = collocated;
                geometries.push(terms);
            }
        }
    }
    let of = |geometry: RendererTerms| {
        let lobes: Vec<Vec<[f64; 3]>> = coarse(&geometry)
            .iter()
            .map(|terms| plain.radiances(terms).iter().map(|rgb| rgb.map(log)).collect())
            .collect();
        let mut found = Vec::new();
        for falloff in Falloff::ALL {
            for (lz, spot) in SPOTS.iter().map(|spot| (None, *spot)).chain([(Some(0.0), 0.0)]) {
                let factor = |point: &Point| {
                    let light = glam::DVec3::from(point.light);
                    let z = (light.z / light.length()).ln();
                    let squared = if falloff == Falloff::Square { light.length_squared().ln() } else { 0.0 };
                    spot * z - squared - if lz.is_some() { z } else { 0.0 }
                };
                let factors: Vec<f64> = plain.points.iter().map(factor).collect();
                let off = lobes.iter().map(|logs| plain.off(1, |i, c| logs[i][c] + factors[i]));
                let mut terms = geometry;
                (terms.light.falloff, terms.light.lz, terms.light.spot) = (falloff, lz, spot);
                found.push((off.fold(f64::INFINITY, f64::min), terms));
            }
        }
        found
    };
    geometries.into_par_iter().flat_map_iter(of).collect()
}

/// The frame with some lobes of each kind.
fn coarse(frame: &RendererTerms) -> Vec<RendererTerms> {
    let mut all = Vec::new();
    for d in Distribution::ALL {
        for alpha in Alpha::ALL {
            for g in [Shadowing::Schlick, Shadowing::Smith, Shadowing::None] {
                let mut terms = *frame;
                (terms.specular.d, terms.material.alpha, terms.specular.g) = (d, alpha, g);
                all.push(terms);
            }
        }
    }
    all
}

/// How the cosines enter the specular term.
const COSINES: [(Denominator, bool); 3] =
    [(Denominator::Cancelled, true), (Denominator::Cancelled, false), (Denominator::Light, false)];

/// The lobes of a frame without their Fresnel term.
fn lobes(frame: &RendererTerms) -> Vec<RendererTerms> {
    let mut all = Vec::new();
    for d in Distribution::ALL {
        for alpha in Alpha::ALL {
            for (g, k) in SHADOWINGS {
                let same = g == Shadowing::Lambda
                    || (k == K::HalfSquare && alpha == Alpha::Square)
                    || (g == Shadowing::SmithBeckmann && d != Distribution::Beckmann);
                let cosines =
                    COSINES.into_iter().chain((g == Shadowing::None).then_some((Denominator::Both, true)));
                for (denominator, spec_cosine) in cosines.filter(|_| !same) {
                    let mut terms = *frame;
                    terms.material.alpha = alpha;
                    (terms.specular.d, terms.specular.g, terms.specular.k) = (d, g, k);
                    (terms.specular.denominator, terms.specular.spec_cosine) = (denominator, spec_cosine);
                    all.push(terms);
                }
            }
        }
    }
    all
}

/// All members of a frame by their parts: specular terms, and diffuse terms by weight and Fresnel term.
fn members(plain: &Plain, frame: &RendererTerms) -> Vec<Candidate> {
    let weights = alternatives::weights(frame.material.material);
    let with = |terms: &RendererTerms, f: Fresnel| {
        let mut terms = *terms;
        terms.specular.f = f;
        terms
    };
    let diffuse: Vec<(Fresnel, Weight, Vec<[f64; 3]>)> = Fresnel::ALL
        .iter()
        .flat_map(|f| weights.iter().map(|weight| (*f, *weight)))
        .map(|(f, weight)| {
            let mut terms = with(frame, f);
            terms.diffuse.diffuse = weight;
            // No point is in front: the diffuse term by itself.
            terms.specular.front_min = Some(f64::INFINITY);
            (f, weight, plain.radiances(&terms))
        })
        .collect();
    /// One in so many values is looked at first, and one in so many members is likely by them.
    const FIRST: usize = 5;
    let of_lobe = |lobe: RendererTerms| {
        Fresnel::ALL.map(|f| {
            let mut specular = with(&lobe, f);
            specular.diffuse.diffuse = Weight::Zero;
            (lobe, f, plain.radiances(&specular))
        })
    };
    let specular: Vec<_> = lobes(frame).into_par_iter().flat_map_iter(of_lobe).collect();
    let of = |every: usize, (lobe, weight): (usize, usize)| {
        let (specular, diffuse) = (&specular[lobe].2, &diffuse[weight].2);
        plain.off(every, |i, c| log(specular[i][c] + diffuse[i][c]))
    };
    let pairs = (0..specular.len()).flat_map(|lobe| (0..diffuse.len()).map(move |diffuse| (lobe, diffuse)));
    let pairs: Vec<_> = pairs.filter(|(lobe, weight)| specular[*lobe].1 == diffuse[*weight].0).collect();
    let mut likely: Vec<_> = pairs.into_par_iter().map(|pair| (of(FIRST, pair), pair)).collect();
    likely.sort_by(|a, b| a.0.total_cmp(&b.0));
    likely.truncate(likely.len().div_ceil(FIRST));
    let candidate = |(_, pair): (f64, (usize, usize))| {
        let ((lobe, f, _), (_, weight, _)) = (&specular[pair.0], &diffuse[pair.1]);
        let mut terms = with(lobe, *f);
        terms.diffuse.diffuse = *weight;
        Candidate { terms, metallic: plain.metallic, off: of(1, pair) }
    };
    likely.into_par_iter().map(candidate).collect()
}

/// The most likely structures, the best first; none where the frames alone are worse than three times `best_frame`, which becomes
/// the least.
pub fn structures(problem: &Problem, workflows: &[bool], best_frame: &mut f64) -> Vec<Candidate> {
    /// Frames of each kind of maps that are searched in full, and structures of each that are refined.
    const FRAMES: usize = 3;
    const STRUCTURES: usize = 2;
    let plain: Vec<Plain> = workflows.iter().map(|metallic| Plain::new(problem, *metallic)).collect();
    let mut scored: Vec<(f64, RendererTerms, usize)> = Vec::new();
    for (which, plain) in plain.iter().enumerate() {
        scored.extend(frames(plain).into_iter().map(|(off, frame)| (off, frame, which)));
    }
    scored.sort_by(|a, b| a.0.total_cmp(&b.0));
    // Of each kind of maps, since the coarse lobes may favour the wrong one.
    let mut kept: Vec<(Maps, usize)> = Vec::new();
    scored.retain(|(_, frame, which)| {
        let kind = (frame.material.material, *which);
        kept.push(kind);
        kept.iter().filter(|other| **other == kind).count() <= FRAMES
    });
    let first = scored.first().map_or(f64::INFINITY, |(off, _, _)| *off);
    if first > 3.0 * *best_frame + 0.01 {
        return Vec::new();
    }
    *best_frame = best_frame.min(first);
    let mut found: Vec<Candidate> =
        scored.iter().flat_map(|(_, frame, which)| members(&plain[*which], frame)).collect();
    found.sort_by(|a, b| a.off.total_cmp(&b.off));
    // Rounded values may not tell the maps apart before the floors are known.
    let kind = |candidate: &Candidate| (candidate.terms.material.material, candidate.metallic);
    let mut kept: Vec<Candidate> = Vec::new();
    for candidate in found {
        if kept.iter().filter(|other| kind(other) == kind(&candidate)).count() < STRUCTURES {
            kept.push(candidate);
        }
    }
    kept
}

/// Changes one term after the other, the steepest first, as long as that helps.
pub fn refined(problem: &Problem, start: &Candidate) -> Fit {
    let mut best = problem.fit(&start.terms, start.metallic);
    for _ in 0..MOST_STEPS {
        if best.is_perfect() {
            break;
        }
        let metallic = best.metallic;
        let words = alternatives::of_words(&best.terms).into_par_iter().map(|(_, terms)| {
            let predicted = problem.predicted(&terms, metallic);
            Tried { number: None, score: problem.score(&terms, metallic, &predicted, f64::INFINITY), terms }
        });
        let word = words.min_by(|a, b| a.score.total_cmp(&b.score));
        let most = word.as_ref().map_or(best.score, |word| word.score.min(best.score));
        // Maps that are out of range tell no number.
        let number = if best.is_explained() { None } else { best_number(problem, &best, most) };
        // Of a word and a number that do as well, the word.
        let tried = match (word, number) {
            (Some(word), Some(number)) if number.score + 1.0 < word.score => number,
            (word, number) => match word.or(number) {
                Some(tried) => tried,
                None => break,
            },
        };
        let mut next = problem.fit(&tried.terms, metallic);
        if let Some((set, value)) = tried.number {
            next = refined_number(problem, next, set, value);
        }
        // Noise is explained by any number, a little.
        let worth = if problem.noise > 0.0 { WORTH } else { 1.0 };
        if next.score > best.score - worth.max(LITTLE * best.score) {
            break;
        }
        best = next;
    }
    simplified(problem, best)
}

/// A renderer that was tried.
struct Tried {
    /// The number that it differs in from the best one.
    number: Option<(alternatives::Set, f64)>,
    score: f64,
    terms: RendererTerms,
}

/// The renderer that differs from `best` in one number and has the least score, where one has less than `most`.
fn best_number(problem: &Problem, best: &Fit, most: f64) -> Option<Tried> {
    let metallic = best.metallic;
    let points = problem.points(metallic);
    let own = problem.predicted(&best.terms, metallic);
    let numbers: Vec<_> = alternatives::of_numbers().collect();
    let of_key = |(_, set, values, is_monotone): (&str, alternatives::Set, &[f64], bool)| {
        let with = |value: f64| {
            let mut terms = best.terms;
            set(&mut terms, value);
            terms
        };
        // The smallest of a ladder, and what the value above has changed of that: no other point can be changed by less.
        let least = problem.predicted(&with(values[0]), metallic);
        let mut predicted: Option<Vec<[f64; 3]>> = None;
        let mut found: Option<Tried> = None;
        for &value in values.iter().rev() {
            let terms = with(value);
            let now: Vec<[f64; 3]> = match &predicted {
                Some(above) if is_monotone => (points.iter().zip(above).zip(&least))
                    .map(
                        |((point, above), least)| {
                            if above == least { *least } else { terms.radiance(point, true) }
                        },
                    )
                    .collect(),
                _ => problem.predicted(&terms, metallic),
            };
            if now != own {
                let most = found.as_ref().map_or(most, |found| found.score);
                let score = problem.score(&terms, metallic, &now, most);
                if score < most {
                    found = Some(Tried { number: Some((set, value)), score, terms });
                }
            }
            predicted = Some(now);
        }
        found
    };
    let found = numbers.into_par_iter().filter_map(of_key);
    found.min_by(|a, b| a.score.total_cmp(&b.score))
}

/// The renderer without the numbers that it does not need.
fn simplified(problem: &Problem, mut fit: Fit) -> Fit {
    loop {
        let fewer = alternatives::without_numbers(&fit.terms).into_iter();
        let fits = fewer.map(|(_, terms)| problem.fit(&terms, fit.metallic));
        match fits.min_by(|a, b| a.score.total_cmp(&b.score)) {
            Some(simpler) if simpler.is_as_good_as(&fit, WORTH / 2.0) => fit = simpler,
            _ => return fit,
        }
    }
}

/// The best value of a number about `value`: golden sections of its logarithm, then the fewest digits that do as well.
fn refined_number(problem: &Problem, fit: Fit, set: alternatives::Set, value: f64) -> Fit {
    const GOLDEN: f64 = 0.618_033_988_749_894_9;
    if fit.is_perfect() {
        return fit;
    }
    let with = |value: f64| {
        let mut terms = fit.terms;
        set(&mut terms, value);
        terms
    };
    let score = |log: f64| {
        let terms = with(log.exp());
        let predicted = problem.predicted(&terms, fit.metallic);
        problem.score(&terms, fit.metallic, &predicted, f64::INFINITY)
    };
    let (mut low, mut high) = ((value / 6.0).ln(), (value * 6.0).min(0.95_f64.max(value)).ln());
    let inner = |low: f64, high: f64| [high - GOLDEN * (high - low), low + GOLDEN * (high - low)];
    let [mut a, mut b] = inner(low, high).map(|log| (log, score(log)));
    for _ in 0..40 {
        // One of the two inner points is one of the next two.
        if a.1 <= b.1 {
            (high, b) = (b.0, a);
            let log = inner(low, high)[0];
            a = (log, score(log));
        } else {
            (low, a) = (a.0, b);
            let log = inner(low, high)[1];
            b = (log, score(log));
        }
    }
    let middle = ((low + high) / 2.0).exp();
    let best = problem.fit(&with(middle), fit.metallic);
    if best.score >= fit.score {
        return fit;
    }
    let rounded = (0..8).map(|digits| {
        let rounded = format!("{middle:.digits$e}").parse().unwrap_or(middle);
        problem.fit(&with(rounded), fit.metallic)
    });
    rounded.into_iter().find(|rounded| rounded.score < best.score + WORTH / 4.0).unwrap_or(best)
}
