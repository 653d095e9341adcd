//! The search of the grammar: first its structure, at points that no floor reaches, then everything at all points.

use svbrdf_core::model::grammar::words::{Alpha, Distribution, Falloff, Maps, NormalY, Shadowing};
use svbrdf_core::model::grammar::{Point, RendererTerms};
use svbrdf_core::parallel;
use svbrdf_core::statistics::sort_by_number;

use super::alternatives::{self, SPOTS, SetNumber};
use super::fit::{Fit, Problem, is_in_range, median, vectors};

/// Largest absolute logarithm that counts in full.
const FARTHEST: f64 = 1.0;
/// Improvement of the score that a further number has to make.
pub const WORTH: f64 = 14.0;
/// The share of the score that a further change has to improve: one that is needed improves more, and what is no member goes on for
/// long by less.
const LITTLE: f64 = 0.005;
/// Most changes of one term after the other.
const MOST_STEPS: usize = 16;

/// The points that no usual floor reaches.
struct Plain {
    points: Vec<Point>,
    /// For each channel the points with a value, and its logarithm.
    values: [Vec<(usize, f64)>; 3],
}

impl Plain {
    fn new(problem: &Problem) -> Self {
        let mut plain = Self { points: Vec::new(), values: Default::default() };
        let ambient = problem.fit(&RendererTerms::BASE).ambient;
        for (point, values) in problem.points.iter().zip(&problem.values) {
            // Either direction of y.
            let is_lit = NormalY::ALL.into_iter().all(|y| {
                let mut terms = RendererTerms::BASE;
                terms.material.normal_y = y;
                let (n, l, v) = vectors(&terms, point);
                n.dot(l) > 0.1 && n.dot(v) > 0.1 && l.z > 0.1
            });
            let is_unit = (glam::DVec3::from(point.normal).length() - 1.0).abs() <= 1e-3;
            if !is_lit || !is_unit || !is_in_range(point) || point.roughness < 0.2 {
                continue;
            }
            let diffuse = problem.diffuse(point);
            for (c, value) in values.iter().enumerate() {
                let lit = value - ambient * diffuse[c];
                if problem.is_value(*value) && lit > 0.0 {
                    plain.values[c].push((plain.points.len(), lit.ln()));
                }
            }
            plain.points.push(*point);
        }
        plain
    }

    /// The mean absolute log ratio to the radiances of a renderer, with the best factor for each channel.
    fn off(&self, terms: &RendererTerms) -> f64 {
        let radiances: Vec<_> = self.points.iter().map(|point| terms.radiance(point, true)).collect();
        let (mut sum, mut count) = (0.0, 1e-9);
        for (c, values) in self.values.iter().enumerate() {
            let ratios: Vec<f64> =
                values.iter().map(|(i, log)| log - radiances[*i][c].max(1e-12).ln()).collect();
            let Some(middle) = median(ratios.clone()) else { continue };
            sum += ratios.iter().map(|log| (log - middle).abs().min(FARTHEST)).sum::<f64>();
            count += ratios.len() as f64;
        }
        sum / count
    }

    /// The renderer after changes of one word after the other, the steepest first, as long as that helps.
    fn descended(&self, (mut off, mut terms): (f64, RendererTerms)) -> (f64, RendererTerms) {
        loop {
            let words = alternatives::of_words(&terms).into_iter();
            let best = words.map(|terms| (self.off(&terms), terms)).min_by(|a, b| a.0.total_cmp(&b.0));
            match best {
                Some((next, changed)) if next < off => (off, terms) = (next, changed),
                _ => return (off, terms),
            }
        }
    }
}

/// Renderers of every kind: whose maps, the frame, the light and some lobes.
fn starts(metallic: bool) -> Vec<RendererTerms> {
    let mut all = vec![RendererTerms::BASE];
    let mut vary = |changes: &[&dyn Fn(&mut RendererTerms)]| {
        all = all
            .iter()
            .flat_map(|terms| {
                changes.iter().map(|change| {
                    let mut changed = *terms;
                    change(&mut changed);
                    changed
                })
            })
            .collect();
    };
    let of_maps = |maps: Maps| {
        move |t: &mut RendererTerms| {
            t.material.material = maps;
            t.diffuse.diffuse = alternatives::weights(maps)[0];
        }
    };
    let maps = if metallic { Maps::Metallic } else { Maps::Diffuse };
    vary(&[&of_maps(maps), &of_maps(Maps::Dielectric)]);
    vary(&[&|_| (), &|t| t.material.normal_y = NormalY::Down]);
    vary(&[&|_| (), &|t| t.light.collocated = true]);
    vary(&[&|_| (), &|t| t.light.falloff = Falloff::Square]);
    vary(&[&|_| (), &|t| t.specular.d = Distribution::Beckmann]);
    vary(&[&|_| (), &|t| t.material.alpha = Alpha::Linear]);
    vary(&[&|_| (), &|t| t.specular.g = Shadowing::Smith, &|t| t.specular.g = Shadowing::None]);
    let spots = SPOTS.map(|spot| move |t: &mut RendererTerms| t.light.spot = spot);
    let spots = spots.iter().map(|set| set as &dyn Fn(&mut RendererTerms));
    vary(&spots.chain([&(|t: &mut RendererTerms| t.light.lz = Some(0.0)) as _]).collect::<Vec<_>>());
    all
}

/// The most likely structures with their mean absolute log ratios.
pub fn structures(problem: &Problem) -> Vec<(f64, RendererTerms)> {
    /// Starts of each kind of maps that are searched.
    const STARTS: usize = 4;
    let plain = Plain::new(problem);
    let starts = starts(problem.metallic);
    let mut scored = parallel::map(starts.len(), |index| (plain.off(&starts[index]), starts[index]));
    sort_by_number(&mut scored, |(off, _)| *off);
    // Of each kind of maps, since the lobes may favour the wrong one.
    let mut likely: Vec<(f64, RendererTerms)> = Vec::new();
    for start in scored {
        let kind = start.1.material.material;
        if likely.iter().filter(|(_, other)| other.material.material == kind).count() < STARTS {
            likely.push(start);
        }
    }
    let mut found = parallel::map(likely.len(), |index| plain.descended(likely[index]));
    sort_by_number(&mut found, |(off, _)| *off);
    found.dedup_by_key(|(_, terms)| *terms);
    found
}

/// Changes one term after the other, the steepest first, as long as that helps, and drops the numbers that are not needed.
pub fn refined(problem: &Problem, start: &RendererTerms) -> Fit {
    let mut best = problem.fit(start);
    for _ in 0..MOST_STEPS {
        if best.is_perfect() {
            break;
        }
        let words = alternatives::of_words(&best.terms);
        let word = best_of(problem, words.len(), |index| words[index]).map(|(fit, _)| fit);
        // Maps that are out of range tell no number.
        let number = if problem.is_explained(&best) { None } else { best_number(problem, &best) };
        // Of a word and a number that do as well, the word.
        let next = match (word, number) {
            (Some(word), Some((number, set, value))) if number.score + 1.0 < word.score => {
                refined_number(problem, number, set, value)
            }
            (Some(word), _) => word,
            (None, Some((number, set, value))) => refined_number(problem, number, set, value),
            (None, None) => break,
        };
        if next.score > best.score - (LITTLE * best.score).max(1.0) {
            break;
        }
        best = next;
    }
    loop {
        let fewer = alternatives::without_numbers(&best.terms).into_iter().map(|terms| problem.fit(&terms));
        match fewer.min_by(|a, b| a.score.total_cmp(&b.score)) {
            Some(simpler) if problem.is_as_good(&simpler, &best, WORTH / 2.0) => best = simpler,
            _ => return best,
        }
    }
}

/// The renderer that differs from `best` in one number and has the least score.
fn best_number(problem: &Problem, best: &Fit) -> Option<(Fit, SetNumber, f64)> {
    let numbers: Vec<_> = alternatives::of_numbers().collect();
    let with = |index: usize| {
        let (set, value): (SetNumber, f64) = numbers[index];
        let mut terms = best.terms;
        set(&mut terms, value);
        terms
    };
    let (fit, index) = best_of(problem, numbers.len(), with)?;
    Some((fit, numbers[index].0, numbers[index].1))
}

/// The fit with the least score of `count` renderers, and its index.
fn best_of(
    problem: &Problem,
    count: usize,
    terms: impl Fn(usize) -> RendererTerms + Sync,
) -> Option<(Fit, usize)> {
    let fits = parallel::map(count, |index| problem.fit(&terms(index)));
    let all = fits.into_iter().zip(0..);
    all.min_by(|(a, _), (b, _)| a.score.total_cmp(&b.score))
}

/// The best value of a number about `value`: golden sections of its logarithm, then the fewest digits that do as well.
fn refined_number(problem: &Problem, fit: Fit, set: SetNumber, value: f64) -> Fit {
    const GOLDEN: f64 = 0.618_033_988_749_894_9;
    if fit.is_perfect() {
        return fit;
    }
    let with = |value: f64| {
        let mut terms = fit.terms;
        set(&mut terms, value);
        problem.fit(&terms)
    };
    let (mut low, mut high) = ((value / 6.0).ln(), (value * 6.0).min(0.95_f64.max(value)).ln());
    for _ in 0..40 {
        let [a, b] = [high - GOLDEN * (high - low), low + GOLDEN * (high - low)];
        if with(a.exp()).score <= with(b.exp()).score { high = b } else { low = a }
    }
    let middle = ((low + high) / 2.0).exp();
    let best = with(middle);
    if best.score >= fit.score {
        return fit;
    }
    let mut rounded = (0..8).map(|digits| with(format!("{middle:.digits$e}").parse().unwrap_or(middle)));
    rounded.find(|rounded| rounded.score < best.score + WORTH / 4.0).unwrap_or(best)
}
