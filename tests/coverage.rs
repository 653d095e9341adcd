//! Whether the 95% interval holds the loss over all scenes in 95% of the seeds.
//!
//! The whole table, over the built-in pairs and those of `../shared`:
//! `cargo test --release --no-default-features -- --ignored coverage --nocapture`

use std::ops::RangeInclusive;
use std::path::Path;

use svbrdf::files::read::{Albedo, ReadOptions, read};
use svbrdf::loss::{Comparison, Compute, Estimate, Loss, Outcome, Request, Sampling, TEXELS, Texels};
use svbrdf::material::{Material, Planes};
use svbrdf::model::convention::PRINTED;
use svbrdf::model::sampler::Sampler;
use svbrdf::progress::Progress;
use svbrdf::samples;

/// Coverage in percent that 2,000 seeds may show.
const ALLOWED: RangeInclusive<f64> = 93.5..=96.5;
/// The same where an accuracy was promised: to hold it more often breaks no promise.
const PROMISED: RangeInclusive<f64> = 93.5..=98.0;

struct Pair {
    ground_truth: Material<f32>,
    prediction: Material<f32>,
    /// The loss over all scenes, in the weights 2 : 1.
    reference: f64,
}

/// What many seeds have shown, in percent: of the seeds, and of the reference.
#[derive(Debug)]
#[expect(dead_code, reason = "printed as a whole")]
struct Seen {
    coverage: f64,
    half_width: f64,
    rms: f64,
    bias: f64,
    /// Standard error of `bias`.
    bias_error: f64,
    scenes: f64,
}

/// Every `step`-th texel of every `step`-th row.
fn thinned(material: &Material<f32>, step: usize) -> Material<f32> {
    let [width, height] = material.size().map(|n| n / step);
    let from = |i: usize| (i / width * step + step / 2) * material.width() + i % width * step + step / 2;
    let plane = |p: &Vec<f32>| (0..width * height).map(|i| p[from(i)]).collect();
    let planes = material.planes();
    let planes = Planes {
        normal: planes.normal.each_ref().map(plane),
        diffuse: planes.diffuse.each_ref().map(plane),
        specular: planes.specular.each_ref().map(plane),
        roughness: plane(&planes.roughness),
    };
    Material::new(material.name(), width, height, planes).unwrap()
}

impl Pair {
    fn new(ground_truth: &Material<f32>, prediction: &Material<f32>, step: usize, log_points: u32) -> Self {
        let [ground_truth, prediction] = [ground_truth, prediction].map(|m| thinned(m, step));
        let mut pair = Self { ground_truth, prediction, reference: 0.0 };
        let (near, distant) = (16 << log_points, 8 << log_points);
        let sampling =
            Sampling { near, distant, seed: 1 << 40, sampler: Sampler::Sobol, texels: Texels::All };
        pair.reference = pair.loss(sampling).estimate.mean;
        pair
    }

    fn comparison(&self) -> Comparison<'_, f32> {
        Comparison::new(&self.ground_truth, &[&self.prediction], PRINTED).unwrap()
    }

    fn loss(&self, sampling: Sampling) -> Loss {
        let request = Request::Scenes(sampling);
        self.comparison().run(&request, &Progress::default()).unwrap().losses.remove(0)
    }

    fn fixed(&self, sampler: Sampler, texels: Texels, count: usize) -> impl Fn(u64) -> (Estimate, usize) {
        move |seed| {
            let (near, distant) = (count / 3 * 2, count / 3);
            (self.loss(Sampling { near, distant, seed, sampler, texels }).estimate, count)
        }
    }

    fn adaptive(&self, target: f64) -> impl Fn(u64) -> (Estimate, usize) {
        move |seed| {
            let mut scenes = 0;
            let count = |outcome: &Outcome| scenes += outcome.scenes.len();
            let request = Request::Accuracy { target, seed };
            let outcome = self.comparison().stream(&request, &Progress::default(), count);
            (outcome.unwrap().losses[0].estimate, scenes)
        }
    }

    fn seen(&self, seeds: u64, estimate: impl Fn(u64) -> (Estimate, usize)) -> Seen {
        let estimates: Vec<_> = (0..seeds).map(estimate).collect();
        let mean = |of: &dyn Fn(&Estimate) -> f64| {
            100.0 * estimates.iter().map(|(e, _)| of(e)).sum::<f64>() / seeds as f64
        };
        let error = |e: &Estimate| e.mean / self.reference - 1.0;
        let covers = |e: &Estimate| {
            let [low, high] = e.interval95.unwrap();
            f64::from((low..=high).contains(&self.reference))
        };
        let rms = 10.0 * mean(&|e| error(e).powi(2)).sqrt();
        Seen {
            coverage: mean(&covers),
            half_width: mean(&Estimate::relative_error95),
            rms,
            bias: mean(&error),
            bias_error: rms / (seeds as f64).sqrt(),
            scenes: estimates.iter().map(|(_, count)| *count as f64).sum::<f64>() / seeds as f64,
        }
    }
}

fn built_in(step: usize, log_points: u32) -> Vec<Pair> {
    let samples = samples::load::<f32>().unwrap();
    let gt = samples.ground_truth.material;
    samples.predictions.iter().map(|p| Pair::new(&gt, &p.material, step, log_points)).collect()
}

fn golden(step: usize, log_points: u32) -> Vec<Pair> {
    let maps = Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/golden/maps");
    let options = ReadOptions { albedo: Some(Albedo::Gamma22), ..ReadOptions::default() };
    let open = |name| read(&maps.join(name), &options, &Progress::default());
    let Ok(gt) = open("gt.png") else { return Vec::new() };
    let predictions = ["l1.png", "rend.png"].map(|name| open(name).unwrap().material);
    predictions.iter().map(|p| Pair::new(&gt.material, p, step, log_points)).collect()
}

/// Few texels of a scene.
const SOME: Texels = Texels::Sampled(32);

#[test]
fn intervals_of_few_scenes_cover_the_loss_and_means_have_no_bias() {
    let pair = &built_in(32, 10)[0];
    let cases = [
        (Sampler::Random, Texels::All, 9),
        (Sampler::Random, Texels::All, 27),
        (Sampler::Sobol, Texels::All, 27),
        (Sampler::Random, SOME, 27),
        (Sampler::Sobol, SOME, 48),
    ];
    for (sampler, texels, count) in cases {
        let seen = pair.seen(600, pair.fixed(sampler, texels, count));
        println!("{sampler}, {count}, {texels} texels: {seen:?}");
        // Three standard errors of 600 seeds.
        assert!((95.0 - seen.coverage).abs() <= 1.5 + 2.7, "{sampler}, {count}, {texels}: {seen:?}");
        assert!(seen.bias.abs() < 4.0 * seen.bias_error, "{sampler}, {count}, {texels}: {seen:?}");
    }
}

#[test]
fn a_biased_choice_of_texels_is_seen() {
    let pair = &built_in(32, 10)[0];
    // Always the same texels, an eighth of those there are.
    let scenes = |seed| Sampler::Sobol.scenes(seed, 320, 160, &PRINTED);
    let texels: Vec<usize> = (0..8).collect();
    let seen = pair.seen(100, |seed| {
        let (scenes, progress) = (scenes(seed), Progress::default());
        let losses = f32::cpu().scene_losses(&pair.comparison(), &scenes, Some(&texels), &progress).unwrap();
        (Estimate::of_sampled(Sampler::Sobol, &scenes, &losses[0]), 480)
    });
    assert!(seen.bias.abs() > 4.0 * seen.bias_error && seen.coverage < 90.0, "{seen:?}");
}

#[test]
fn sobol_scenes_have_less_error_than_random_ones() {
    let pair = &built_in(32, 10)[0];
    let [random, sobol] =
        [Sampler::Random, Sampler::Sobol].map(|s| pair.seen(60, pair.fixed(s, Texels::All, 384)).rms);
    println!("rms {random:.2}% random, {sobol:.2}% Sobol");
    assert!(sobol < 0.7 * random, "{sobol}% against {random}%");
}

#[test]
fn an_adaptive_loss_keeps_its_promise() {
    let pair = &built_in(8, 7)[0];
    let seen = pair.seen(400, pair.adaptive(0.05));
    println!("{seen:?}");
    // Three standard errors of 400 seeds.
    assert!((95.0 - seen.coverage).abs() <= 1.5 + 3.3 && seen.half_width <= 5.0, "{seen:?}");
    assert!(seen.bias.abs() < 4.0 * seen.bias_error, "{seen:?}");
}

/// What has been seen, and what of it is wrong.
#[derive(Default)]
struct Table(Vec<String>);

impl Table {
    fn note(&mut self, pair: &Pair, what: &str, allowed: RangeInclusive<f64>, seen: Seen) {
        let line = format!("{}, {what}: {seen:.3?}", pair.prediction.name());
        println!("{line}");
        if !allowed.contains(&seen.coverage) || seen.bias.abs() > 4.0 * seen.bias_error {
            self.0.push(line);
        }
    }

    fn check(&self) {
        assert!(self.0.is_empty(), "{}", self.0.join("\n"));
    }
}

#[test]
#[ignore = "a minute: a table of coverages, see above"]
fn coverage_of_all_texels() {
    let mut table = Table::default();
    for pair in built_in(16, 13).into_iter().chain(golden(16, 13)) {
        for sampler in [Sampler::Random, Sampler::Sobol] {
            for count in [9, 27, 90, 900] {
                // Where that is quick, more seeds than are asked for: the coverage itself is then known to 0.2%.
                let seeds = if count < 90 { 10_000 } else { 2_000 };
                let seen = pair.seen(seeds, pair.fixed(sampler, Texels::All, count));
                table.note(&pair, &format!("{sampler} {count}, 16 x 16"), ALLOWED, seen);
            }
        }
    }
    table.check();
}

#[test]
#[ignore = "minutes: a table of coverages, see above"]
fn coverage_of_some_texels() {
    let mut table = Table::default();
    for pair in built_in(1, 11).into_iter().chain(golden(1, 11)) {
        for sampler in [Sampler::Random, Sampler::Sobol] {
            let texels = Texels::Sampled(TEXELS);
            for count in [27, 90, 900] {
                let seen = pair.seen(2_000, pair.fixed(sampler, texels, count));
                let what = format!("{sampler} {count}, {texels} texels of 256 x 256");
                table.note(&pair, &what, ALLOWED, seen);
            }
        }
    }
    table.check();
}

#[test]
#[ignore = "minutes: a table of coverages, see above"]
fn coverage_of_adaptive_losses() {
    let mut table = Table::default();
    for pair in built_in(1, 11).into_iter().chain(golden(1, 11)) {
        for target in [0.03, 0.01] {
            let seen = pair.seen(2_000, pair.adaptive(target));
            table.note(&pair, &format!("accuracy {target}"), PROMISED, seen);
        }
    }
    table.check();
}
