//! Many predictions, many materials: places, groups, and intervals over materials.

use std::collections::BTreeMap;

use rand::rngs::ChaCha8Rng;
use rand::{RngExt as _, SeedableRng as _};
use rayon::prelude::*;

use svbrdf_core::loss::{Comparison, Request};
use svbrdf_core::material::Map;
use svbrdf_core::model::convention::Convention;
use svbrdf_core::progress::Progress;
use svbrdf_core::rank;
use svbrdf_files::dataset::{
    KnownLoss, Mark, MaterialResult, Pick, PredictionResult, best_by_metric, interval_of_mean, summarize,
    summarize_marks, summarize_metrics,
};
use svbrdf_files::samples;

#[test]
fn predictions_are_ranked_and_equal_ones_share_a_group() {
    let built_in = samples::load::<f32>().unwrap();
    let truth = &built_in.ground_truth.material;
    let [blurred, rough] = [0, 1].map(|i| &built_in.predictions[i].material);
    let both = blurred.with_maps_of(rough, |map| map == Map::Roughness).unwrap();
    let all = [blurred, rough, &both, rough];
    let comparison = Comparison::new(truth, &all, Convention::default()).unwrap();
    let request = Request::Accuracy { target: 0.02, seed: 0 };
    let outcome = comparison.run(&request, &Progress::default()).unwrap();
    let places = rank::places(&outcome);
    let found: Vec<_> = places.iter().map(|place| (place.index, place.group)).collect();
    assert_eq!(found, [(1, 1), (3, 1), (0, 2), (2, 3)]);
    let losses: Vec<f64> = places.iter().map(|place| outcome.losses[place.index].estimate.mean).collect();
    assert!(losses.is_sorted(), "{losses:?}");
    assert_eq!(places[0].to_best, None);
    for (place, loss) in places.iter().zip(&losses).skip(1) {
        let difference = place.to_best.unwrap();
        assert!((difference.mean - (loss - losses[0])).abs() < 1e-12, "{difference:?}");
    }
}

/// Populations by name: their mean, and how a value is drawn.
type Population = (&'static str, f64, fn(&mut ChaCha8Rng) -> f64);

fn uniform(generator: &mut ChaCha8Rng) -> f64 {
    generator.random_range(f64::MIN_POSITIVE..1.0)
}

fn normal(generator: &mut ChaCha8Rng) -> f64 {
    let length = (-2.0 * uniform(generator).ln()).sqrt();
    length * (std::f64::consts::TAU * uniform(generator)).cos()
}

const POPULATIONS: [Population; 4] = [
    ("normal", 3.0, |g| 3.0 + normal(g)),
    ("exponential", 1.0, |g| -uniform(g).ln()),
    ("gamma of shape 4", 4.0, |g| (0..4).map(|_| -uniform(g).ln()).sum()),
    ("log-normal", 1.133_148_453_066_826_3, |g| (0.5 * normal(g)).exp()),
];

/// In how many of `repeats` samples of `size` values the interval holds the mean, in percent.
fn coverage((_, mean, draw): Population, size: usize, repeats: u64, interval: fn(&[f64]) -> [f64; 2]) -> f64 {
    let held = |seed| {
        let mut generator = ChaCha8Rng::seed_from_u64(seed);
        let values: Vec<f64> = (0..size).map(|_| draw(&mut generator)).collect();
        let [low, high] = interval(&values);
        low <= mean && mean <= high
    };
    100.0 * (0..repeats).into_par_iter().filter(|&seed| held(seed)).count() as f64 / repeats as f64
}

#[test]
fn intervals_over_materials_hold_the_mean_of_made_populations() {
    let allowed = 93.5..=96.5;
    for population in POPULATIONS {
        let covered = coverage(population, 40, 2000, |values| interval_of_mean(values).unwrap());
        println!("{}: {covered}%", population.0);
        assert!(allowed.contains(&covered), "{}: {covered}%", population.0);
    }
    let narrow = |values: &[f64]| {
        let [low, high] = interval_of_mean(values).unwrap();
        [low + 0.1 * (high - low), high - 0.1 * (high - low)]
    };
    let covered = coverage(POPULATIONS[1], 40, 400, narrow);
    assert!(!allowed.contains(&covered), "an interval that is too narrow is not seen: {covered}%");
}

#[test]
fn few_or_equal_values_have_no_interval_or_no_width() {
    assert_eq!(interval_of_mean(&[1.0, 2.0]), None);
    assert_eq!(interval_of_mean(&[0.5; 5]), Some([0.5; 2]));
    let [low, high] = interval_of_mean(&[1.0, 1.0, 2.0]).unwrap();
    assert!(low < 4.0 / 3.0 && 4.0 / 3.0 < high, "{low}, {high}");
}

fn result(index: usize, losses: &[(&str, Option<f64>)]) -> MaterialResult {
    let mut predictions: Vec<PredictionResult> = Vec::new();
    for (method, loss) in losses {
        let sample = predictions.iter().filter(|p| p.method == *method).count();
        let known = |loss| KnownLoss { loss, standard_error: 0.01, interval95: [loss - 0.02, loss + 0.02] };
        let metrics: BTreeMap<String, f64> =
            loss.map(|loss| ("rmse_roughness".to_owned(), 10.0 * loss)).into_iter().collect();
        let result = loss.map(known).ok_or_else(|| "broken".to_owned());
        predictions.push(PredictionResult {
            method: (*method).to_owned(),
            sample,
            path: String::new(),
            result,
            metrics: metrics.clone(),
            marks: None,
        });
    }
    MaterialResult { index, material: format!("m{index}"), seed: 0, scenes: 9, floor: None, predictions }
}

#[test]
fn methods_are_compared_over_the_materials_of_both() {
    let results: Vec<MaterialResult> = (0..9)
        .map(|i| {
            let base = 0.1 + 0.1 * i as f64;
            let b = (i != 4).then_some(base + 0.05 + 0.001 * (i % 3) as f64);
            result(i, &[("a", Some(base)), ("b", b)])
        })
        .collect();
    let methods = ["b", "a"].map(str::to_owned);
    let [a, b] = summarize(&methods, &results, Pick::Fixed).try_into().unwrap();
    assert_eq!((a.method.as_str(), a.materials, a.failures), ("a", 9, 0));
    assert_eq!((b.materials, b.failures), (8, 1));
    assert!((a.mean - 0.5).abs() < 1e-12 && (a.median - 0.5).abs() < 1e-12, "{a:?}");
    assert!((a.interval95_scenes[1] - a.mean - 1.96 * 0.01 / 3.0).abs() < 1e-6);
    // Materials differ far more than methods: only paired, the difference is known.
    let [low, high] = a.interval95_materials.unwrap();
    assert!(low < b.mean && b.mean < high, "{a:?}");
    let difference = b.to_best.unwrap();
    let [low, high] = difference.interval95_materials.unwrap();
    assert!(0.05 < low && low < difference.mean && difference.mean < high && high < 0.052, "{difference:?}");
    assert!(a.ties_with_best() && !b.ties_with_best());
}

#[test]
fn marks_are_counted_by_material_and_method_and_follow_the_pick() {
    let mark = |hypothesis: &str| Mark {
        hypothesis: hypothesis.to_owned(),
        value: "flipped".into(),
        share: 0.5,
        remedy: None,
    };
    let methods = |floor: f64, marks: [&[&str]; 3], losses: [f64; 3]| {
        let names = ["a", "a", "b"].into_iter().zip(losses.map(Some)).collect::<Vec<_>>();
        let mut result = result(0, &names);
        result.floor = Some(floor);
        for (prediction, marks) in result.predictions.iter_mut().zip(marks) {
            prediction.marks = Some(marks.iter().map(|name| mark(name)).collect());
        }
        result
    };
    let results = [
        methods(0.1, [&["normal_y", "shift"], &[], &[]], [0.3, 0.2, 0.35]),
        methods(0.1, [&["normal_y"], &["exposure"], &["shift"]], [0.05, 0.6, 0.4]),
        // Not diagnosed.
        result(2, &[("a", Some(0.3)), ("b", None)]),
    ];
    let of = |method, pick| summarize_marks(method, Some("b").filter(|best| *best != method), &results, pick);
    let fixed = of("a", Pick::Fixed).unwrap();
    assert_eq!((fixed.materials, fixed.marked, fixed.not_resolvable), (2, 2, 1));
    assert_eq!(fixed.by, [("normal_y".to_owned(), 2), ("shift".to_owned(), 1)].into());
    // 0.3 and 0.35 are nearer than the floor, 0.05 and 0.4 are not.
    assert_eq!(fixed.to_best_not_resolvable, Some(1));
    let best = of("a", Pick::Best).unwrap();
    assert_eq!((best.marked, best.by.get("shift")), (1, None));
    let mean = of("a", Pick::Mean).unwrap();
    assert_eq!((mean.marked, mean.by["exposure"], mean.not_resolvable), (2, 1, 0));
    assert_eq!(of("b", Pick::Fixed).unwrap().to_best_not_resolvable, None);
    assert_eq!(summarize_marks("a", None, &results[2..], Pick::Fixed), None);
}

#[test]
fn of_several_samples_the_pick_counts() {
    let losses =
        [("a", Some(0.3)), ("a", Some(0.1)), ("a", None), ("a", Some(0.2)), ("b", None), ("b", Some(0.4))];
    let results = [result(0, &losses)];
    let of = |pick| {
        let methods = ["a", "b"].map(str::to_owned);
        let summaries = summarize(&methods, &results, pick);
        ["a", "b"].map(|name| summaries.iter().find(|summary| summary.method == name).unwrap().mean)
    };
    assert_eq!(of(Pick::Fixed)[0], 0.3);
    assert!(of(Pick::Fixed)[1].is_nan(), "the first one of b is broken");
    assert_eq!(of(Pick::Best), [0.1, 0.4]);
    assert!((of(Pick::Mean)[0] - 0.2).abs() < 1e-15);
}

#[test]
fn metrics_over_materials_follow_the_pick_of_the_losses() {
    let methods = |i: usize| {
        let base = 0.1 + 0.1 * i as f64;
        result(
            i,
            &[("a", Some(base + 0.02)), ("a", Some(base)), ("b", (i > 1).then_some(base)), ("b", Some(0.3))],
        )
    };
    let results: Vec<MaterialResult> = (0..5).map(methods).collect();
    let mean = |method: &str, pick| summarize_metrics(method, &results, pick)["rmse_roughness"];
    for (pick, expected) in [(Pick::Fixed, 3.2), (Pick::Best, 3.0), (Pick::Mean, 3.1)] {
        let got = mean("a", pick);
        assert!(
            (got.mean - expected).abs() < 1e-12 && (got.median - expected).abs() < 1e-12,
            "{pick}: {got:?}"
        );
        let [low, high] = got.interval95_materials.unwrap();
        assert!(low < expected && expected < high);
    }
    // Two materials without a first prediction do not count.
    assert!((mean("b", Pick::Fixed).mean - 4.0).abs() < 1e-12);
    assert!(summarize_metrics("c", &results, Pick::Mean).is_empty());
}

#[test]
fn the_best_of_a_metric_ties_with_what_the_materials_cannot_separate() {
    // Of a the losses differ by material far more than from those of b, which are larger everywhere; those of c are a little larger
    // or smaller than those of a; d has no predictions.
    let of = |material: usize| {
        let base = 1.0 + material as f64;
        let off = if material.is_multiple_of(2) { 0.011 } else { -0.01 };
        let mut result =
            result(material, &[("a", Some(base)), ("b", Some(base + 0.1)), ("c", Some(base + off))]);
        for prediction in &mut result.predictions {
            let rmse = prediction.metrics["rmse_roughness"];
            prediction.metrics.insert("ssim11_roughness".to_owned(), rmse);
        }
        result
    };
    let results: Vec<MaterialResult> = (0..8).map(of).collect();
    let best = best_by_metric(&["a", "b", "c", "d"], &results, Pick::Fixed);
    assert_eq!(best["rmse_roughness"], [true, false, true, false]);
    // Of similarities the largest is the best.
    assert_eq!(best["ssim11_roughness"], [false, true, false, false]);
    assert_eq!(best.len(), 2);
    // Two materials separate nothing.
    let best = best_by_metric(&["a", "b"], &results[..2], Pick::Fixed);
    assert_eq!(best["rmse_roughness"], [true, true]);
}
