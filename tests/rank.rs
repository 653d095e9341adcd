//! Many predictions, many materials: places, groups, and intervals over materials.

use rand::rngs::ChaCha8Rng;
use rand::{RngExt as _, SeedableRng as _};
use rayon::prelude::*;

use svbrdf_core::loss::{Comparison, Request};
use svbrdf_core::material::Map;
use svbrdf_core::model::convention::Convention;
use svbrdf_core::progress::Progress;
use svbrdf_evaluate::dataset::{
    DatasetReading, DatasetReport, DatasetSettings, FEWEST, KnownLoss, Mark, MaterialResult, MethodSummary,
    MetricRow, Pick, PredictionResult, Source, best_by_metric, interval_of_mean, interval_of_mean_within,
    interval_of_median,
};
use svbrdf_evaluate::metrics::MetricSelection;
use svbrdf_evaluate::rank;
use svbrdf_files::convention::ChosenConvention;
use svbrdf_files::samples;

const REQUEST: Request = Request::Accuracy { target: 0.01, seed: 0 };

fn of_row<'a>(rows: &'a [(MetricRow, Vec<bool>)], metric: &str) -> &'a [bool] {
    &rows.iter().find(|(row, _)| row.metric == metric).unwrap().1
}

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
fn coverage(
    (_, mean, draw): Population,
    size: usize,
    repeats: u64,
    interval: impl Fn(&[f64]) -> [f64; 2] + Sync,
) -> f64 {
    let held = |seed| {
        let mut generator = ChaCha8Rng::seed_from_u64(seed);
        let values: Vec<f64> = (0..size).map(|_| draw(&mut generator)).collect();
        let [low, high] = interval(&values);
        low <= mean && mean <= high
    };
    100.0 * (0..repeats).into_par_iter().filter(|&seed| held(seed)).count() as f64 / repeats as f64
}

/// Of these, one value in ten is ten times as large as the others.
const OUTLIERS: Population = ("outliers", 1.9, |g| {
    let factor = if uniform(g) < 0.1 { 10.0 } else { 1.0 };
    factor * (0.4 * normal(g) - 0.08).exp()
});

#[test]
fn intervals_over_materials_hold_the_mean_of_made_populations() {
    let allowed = 93.5..=96.5;
    for population in POPULATIONS {
        for size in [FEWEST, 40] {
            // One of the normal values in 740 is below 0.
            let covered = coverage(population, size, 2000, |values| {
                interval_of_mean(&values.iter().map(|value| value.abs()).collect::<Vec<_>>()).unwrap()
            });
            println!("{} of {size}: {covered}%", population.0);
            let allowed = if size == FEWEST { 92.5..=96.5 } else { allowed.clone() };
            assert!(allowed.contains(&covered), "{} of {size}: {covered}%", population.0);
        }
    }
    for (size, least) in [(FEWEST, 88.0), (30, 89.0), (40, 91.0)] {
        let covered = coverage(OUTLIERS, size, 2000, |values| interval_of_mean(values).unwrap());
        println!("one of ten far worse, of {size}: {covered}%");
        assert!(covered >= least, "of {size}: {covered}%");
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
    assert_eq!(interval_of_mean(&[1.0; FEWEST - 1]), None);
    assert_eq!(interval_of_mean(&[0.5; FEWEST]), Some([0.5; 2]));
    // One value that differs, which a third of the resamples leave out, does not make the interval meaningless.
    let mut values = [1.0; FEWEST];
    values[..4].copy_from_slice(&[1.0001, 0.9999, 1.0, 0.8]);
    let [low, high] = interval_of_mean(&values).unwrap();
    assert!(0.7 < low && low < 0.99 && 0.99 < high && high < 1.3, "{low}, {high}");
    // By the binomial distribution: of 5 no signs are significant, of 6 all alike, of 9 all but one, of 20 all but five.
    assert_eq!(interval_of_median(&[1.0; 5]), None);
    let ends = |count: usize| interval_of_median(&(0..count).map(|i| i as f64).collect::<Vec<_>>()).unwrap();
    assert_eq!([ends(6), ends(9), ends(20)], [[0.0, 5.0], [1.0, 7.0], [5.0, 14.0]]);
}

#[test]
fn intervals_stay_in_the_range_of_their_values() {
    let mut skewed = [0.001; FEWEST];
    skewed[0] = 0.9;
    let [low, high] = interval_of_mean(&skewed).unwrap();
    assert!(low < 0.0 || high > 1.0, "the values show nothing: {low}, {high}");
    let [low, high] = interval_of_mean_within(&skewed, &(0.0..=1.0)).unwrap();
    assert!((0.0..0.045).contains(&low) && (0.045..=1.0).contains(&high), "{low}, {high}");
    let results: Vec<MaterialResult> =
        skewed.iter().enumerate().map(|(i, loss)| result(i, &[("a", Some(*loss))])).collect();
    let DatasetReport { methods, .. } = ranked(&["a"], &results, Pick::Fixed);
    let [low, high] = methods[0].interval95_scenes;
    assert!(0.0 < low && low < high, "{low}, {high}");
}

/// The losses of a material by method, each also as its RMSE of roughness. Those of one method again are its samples.
pub fn result(index: usize, losses: &[(&str, Option<f64>)]) -> MaterialResult {
    let known =
        |loss| KnownLoss { loss, standard_error: 0.01, interval95: [loss - 0.02, loss + 0.02], scenes: 9 };
    let prediction = |(place, (method, loss)): (usize, &(&str, Option<f64>))| PredictionResult {
        method: (*method).to_owned(),
        sample: losses[..place].iter().filter(|(earlier, _)| earlier == method).count(),
        known: loss.map(known),
        error: loss.is_none().then(|| "broken".to_owned()),
        metrics: loss.map(|loss| ("rmse_roughness".to_owned(), loss)).into_iter().collect(),
        ..PredictionResult::default()
    };
    let (material, predictions) = (format!("m{index}"), losses.iter().enumerate().map(prediction).collect());
    MaterialResult { index, material, seed: 0, reading: Vec::new(), floor: None, predictions }
}

fn ranked(methods: &[&str], results: &[MaterialResult], pick: Pick) -> DatasetReport {
    let methods = methods.iter().map(|method| (*method).to_owned()).collect();
    let settings =
        DatasetSettings::new(Source::Table("pairs.csv".into()), ChosenConvention::default(), REQUEST, &[]);
    let metrics = Some(MetricSelection::default());
    let settings = DatasetSettings { methods, metrics, ..settings };
    DatasetReport::new(settings, DatasetReading::default(), results.to_vec(), pick)
}

fn summary<'a>(report: &'a DatasetReport, method: &str) -> &'a MethodSummary {
    report.methods.iter().find(|summary| summary.method == method).unwrap()
}

#[test]
fn methods_are_compared_over_the_materials_of_both() {
    let results: Vec<MaterialResult> = (0..27)
        .map(|i| {
            let base = 0.1 + 0.1 * (i % 9) as f64;
            result(i, &[("a", Some(base)), ("b", Some(base + 0.05 + 0.001 * (i % 3) as f64))])
        })
        .collect();
    let [a, b] = ranked(&["b", "a"], &results, Pick::Fixed).methods.try_into().unwrap();
    assert_eq!((a.method.as_str(), a.materials, a.failures), ("a", 27, 0));
    assert_eq!((b.materials, b.failures), (27, 0));
    assert!((a.mean - 0.5).abs() < 1e-12 && (a.median - 0.5).abs() < 1e-12, "{a:?}");
    assert!(
        (a.interval95_scenes[1] - a.mean * (1.959_964 * 0.01 / 27_f64.sqrt() / a.mean).exp()).abs() < 1e-6
    );
    // Materials differ far more than methods: only paired, the difference is known.
    let [low, high] = a.interval95_materials.unwrap();
    assert!(low < b.mean && b.mean < high, "{a:?}");
    let (difference, [low, high]) = (b.to_best.unwrap(), b.to_best_interval95_materials.unwrap());
    assert!(0.05 < low && low < difference && difference < high && high < 0.052, "{b:?}");
    assert!(a.ties_with_best && !b.ties_with_best);
}

#[test]
fn a_method_that_lacks_materials_is_never_the_best() {
    // The easy one of four alone, where it is worse: its mean over that one is the smallest of all.
    let results: Vec<MaterialResult> = (0..4)
        .map(|i| {
            let [a, b] = [0.05 + 0.1 * i as f64, 0.06 + 0.1 * i as f64];
            result(
                i,
                &[("a", Some(a)), ("b", Some(b)), ("few", (i == 0).then_some(a + 0.01)), ("none", None)],
            )
        })
        .collect();
    let report = ranked(&["none", "few", "b", "a"], &results, Pick::Fixed);
    let names: Vec<&str> = report.methods.iter().map(|summary| summary.method.as_str()).collect();
    assert_eq!(names, ["a", "b", "few", "none"]);
    let [a, b, few, none] = report.methods.clone().try_into().unwrap();
    assert!(few.mean < a.mean && !few.ties_with_best && !none.ties_with_best, "{few:?}");
    assert!((few.to_best.unwrap() - 0.01).abs() < 1e-12, "paired, it is worse");
    assert_eq!([a.count(), few.count(), none.count()], ["4", "1 of 4", "0 of 4"]);
    assert!(a.compared && b.compared && !few.compared && !none.compared);
    assert_eq!(report.compared_materials.len(), 4);
    let over = report.conditions().join("\n");
    assert!(over.contains("the 4 materials that all 2 compared methods have"), "{over}");
    assert!(over.contains("few has 1 of 4 materials: not compared"), "{over}");
    let best = best_by_metric(&report);
    assert_eq!(of_row(&best, "rmse_roughness"), [true, true, false, false]);
}

#[test]
fn methods_that_lack_one_material_each_are_compared_over_the_others() {
    let results: Vec<MaterialResult> = (0..6)
        .map(|i| {
            let base = 0.1 * (1 + i) as f64;
            // No method has the last one: its ground truth is broken.
            let known = |lacks: usize| (i != lacks && i != 5).then_some(base);
            result(
                i,
                &[
                    ("a", known(0)),
                    ("b", known(4).map(|loss| 1.1 * loss)),
                    ("c", known(0).filter(|_| i == 1)),
                ],
            )
        })
        .collect();
    let report = ranked(&["a", "b", "c"], &results, Pick::Fixed);
    assert_eq!(report.compared_materials, ["m1", "m2", "m3"]);
    let [a, b, c] = report.methods.clone().try_into().unwrap();
    assert!((a.mean - 0.3).abs() < 1e-12 && (b.mean - 0.33).abs() < 1e-12, "{a:?} {b:?}");
    assert!(a.compared && b.compared && !c.compared);
    assert!(report.conditions()[0].contains("the 3 of 6 materials"), "{:?}", report.conditions());
    // Methods without a material in common have no place.
    let apart = [result(0, &[("a", Some(0.1)), ("b", None)]), result(1, &[("a", None), ("b", Some(0.2))])];
    let report = ranked(&["a", "b"], &apart, Pick::Fixed);
    assert!(report.methods.iter().all(|one| !one.compared && !one.ties_with_best));
    assert!(report.best().is_none() && report.conditions()[0].contains("nothing is compared"));
}

#[test]
fn the_mean_psnr_is_that_of_the_materials_and_the_pooled_one_that_of_their_square_errors() {
    let results: Vec<MaterialResult> = (0..36_usize)
        .map(|i| {
            let mut result = result(i, &[("a", Some(0.2)), ("b", Some(0.3)), ("same", Some(0.4))]);
            for (prediction, psnr) in result.predictions.iter_mut().zip([
                if i % 12 == 0 { f64::INFINITY } else { 20.0 + 0.1 * (i % 12) as f64 },
                30.0 + 0.1 * (i % 12) as f64,
                f64::INFINITY,
            ]) {
                prediction.metrics.insert("psnr_diffuse".to_owned(), psnr);
            }
            result
        })
        .collect();
    let report = ranked(&["a", "b", "same"], &results, Pick::Fixed);
    let of = |place: usize| report.methods[place].metrics["psnr_diffuse"];
    assert!((of(0).mean - 20.6).abs() < 1e-12 && of(0).infinite == 3, "{:?}", of(0));
    assert!(report.conditions().iter().any(|line| line.starts_with("a: up to 3 materials with equal maps")));
    let pooled = report.methods[0].metrics["psnr_pooled_diffuse"];
    let square_errors = (1..12).map(|i| 10_f64.powf(-(20.0 + 0.1 * f64::from(i)) / 10.0)).sum::<f64>();
    assert!((pooled.mean - (-10.0 * (square_errors / 12.0).log10())).abs() < 1e-12, "{pooled:?}");
    let [low, high] = of(1).interval95_materials.unwrap();
    assert!(30.0 < low && low < of(1).mean && of(1).mean < high && high < 31.2, "{:?}", of(1));
    assert_eq!(of(2).mean, f64::INFINITY);
    let best = best_by_metric(&report);
    assert_eq!(of_row(&best, "psnr_diffuse"), [false, false, true], "equal maps are the best");
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
    let of = |method: &str, pick| summary(&ranked(&["a", "b"], &results, pick), method).marks.clone();
    let fixed = of("a", Pick::Fixed).unwrap();
    assert_eq!((fixed.materials, fixed.marked, fixed.not_resolvable), (2, 2, 1));
    assert_eq!(fixed.by, [("normal_y".to_owned(), 2), ("shift".to_owned(), 1)].into());
    // b lacks a material: a is the best. 0.3 and 0.35 are nearer than the floor, 0.05 and 0.4 are not.
    assert_eq!(fixed.to_best_not_resolvable, None);
    assert_eq!(of("b", Pick::Fixed).unwrap().to_best_not_resolvable, Some(1));
    let best = of("a", Pick::Best).unwrap();
    assert_eq!((best.marked, best.by.get("shift")), (1, None));
    let mean = of("a", Pick::Mean).unwrap();
    assert_eq!((mean.marked, mean.by["exposure"], mean.not_resolvable), (2, 1, 0));
    let none = ranked(&["a"], &results[2..], Pick::Fixed);
    assert_eq!(summary(&none, "a").marks, None);
}

#[test]
fn of_several_samples_the_pick_counts() {
    let losses =
        [("a", Some(0.3)), ("a", Some(0.1)), ("a", None), ("a", Some(0.2)), ("b", None), ("b", Some(0.4))];
    let results = [result(0, &losses)];
    let of = |pick| {
        let report = ranked(&["a", "b"], &results, pick);
        ["a", "b"].map(|name| summary(&report, name).mean)
    };
    assert_eq!(of(Pick::Fixed)[0], 0.3);
    assert!(of(Pick::Fixed)[1].is_nan(), "the first one of b is broken");
    assert_eq!(of(Pick::Best), [0.1, 0.4]);
    assert!((of(Pick::Mean)[0] - 0.2).abs() < 1e-15);
}

#[test]
fn metrics_over_materials_follow_the_pick_of_the_losses() {
    let methods = |i: usize| {
        let base = 0.1 + 0.1 * (i % 5) as f64;
        result(
            i,
            &[
                ("a", Some(base + 0.02)),
                ("a", Some(base)),
                ("b", (i % 5 > 1).then_some(base)),
                ("b", Some(0.3)),
            ],
        )
    };
    let results: Vec<MaterialResult> = (0..25).map(methods).collect();
    let metrics =
        |method: &str, pick| summary(&ranked(&["a", "b", "c"], &results, pick), method).metrics.clone();
    let mean = |method: &str, pick| metrics(method, pick)["rmse_roughness"];
    for (pick, expected) in [(Pick::Fixed, 0.32), (Pick::Best, 0.3), (Pick::Mean, 0.31)] {
        let got = mean("a", pick);
        assert!(
            (got.mean - expected).abs() < 1e-12 && (got.median - expected).abs() < 1e-12,
            "{pick}: {got:?}"
        );
        let [low, high] = got.interval95_materials.unwrap();
        assert!(low < expected && expected < high);
    }
    // Two materials without a first prediction do not count.
    assert!((mean("b", Pick::Fixed).mean - 0.4).abs() < 1e-12);
    assert!(metrics("c", Pick::Mean).is_empty());
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
    // In the order of their losses: a, c, b, and d, which has none.
    let best = best_by_metric(&ranked(&["a", "b", "c", "d"], &results, Pick::Fixed));
    assert_eq!(of_row(&best, "rmse_roughness"), [true, true, false, false]);
    // Of similarities the largest is the best.
    assert_eq!(of_row(&best, "ssim11_roughness"), [false, false, true, false]);
    assert_eq!(best.len(), 2);
    // Two materials separate nothing.
    let best = best_by_metric(&ranked(&["a", "b"], &results[..2], Pick::Fixed));
    assert_eq!(of_row(&best, "rmse_roughness"), [true, true]);
}
