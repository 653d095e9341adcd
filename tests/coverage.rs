//! Whether the 95% interval holds the loss over all scenes in 95% of the seeds.

pub(crate) mod measured;
mod pairs;

use rayon::prelude::*;
use svbrdf_core::loss::{Compute, Estimate, Request, Sampling, Texels};
use svbrdf_core::model::convention::PRINTED;
use svbrdf_core::model::sampler::Sampler;
use svbrdf_core::progress::Progress;

use measured::{Pair, allowed, built_in, holds, made};

/// Seeds of a cell of the short tests.
const SEEDS: u64 = 100;
/// Seeds of a test of one cell, whose bound is on both sides.
const MORE_SEEDS: u64 = 400;
/// Few texels of a scene.
const SOME: Texels = Texels::Sampled(32);

fn covers(seeds: u64, coverage: f64) -> bool {
    let [least, most] = allowed(seeds);
    (least..=most).contains(&coverage)
}

/// Checks each cell, and all together: 100 seeds tell intervals that are too narrow, not those that are too wide.
fn check(cells: &[(&Pair, Sampler, Texels, usize)]) {
    let mut sum = 0.0;
    for (number, &(pair, sampler, texels, count)) in cells.iter().enumerate() {
        let estimate = pair.fixed(sampler, texels, count);
        // Cells share no seed, so that their sum has the binomial distribution.
        let seen = pair.seen(SEEDS, |seed| estimate(SEEDS * number as u64 + seed));
        let cell = format!("{}, {sampler} {count}, {texels} texels: {seen:?}", pair.name());
        println!("{cell}");
        assert!(covers(SEEDS, seen.coverage) && seen.bias.abs() < 4.0 * seen.bias_error, "{cell}");
        sum += seen.coverage;
    }
    let coverage = sum / cells.len() as f64;
    assert!(covers(SEEDS * cells.len() as u64, coverage), "{coverage}% over all cells");
}

#[test]
fn intervals_of_few_scenes_cover_the_loss_and_means_have_no_bias() {
    let pair = &built_in(32, 10)[0];
    check(&[
        (pair, Sampler::Random, Texels::All, 9),
        (pair, Sampler::Random, Texels::All, 27),
        (pair, Sampler::Sobol, Texels::All, 27),
        (pair, Sampler::Random, SOME, 27),
        (pair, Sampler::Sobol, SOME, 48),
    ]);
}

#[test]
fn intervals_cover_the_loss_of_materials_that_differ_in_kind() {
    let small = made(8, 10);
    // More texels than a pilot compares.
    let patch = &made(40, 8)[1];
    let cells = small
        .iter()
        .flat_map(|pair| [(pair, Sampler::Random, Texels::All, 9), (pair, Sampler::Sobol, Texels::All, 27)]);
    check(&cells.chain([(patch, Sampler::Random, Texels::All, 9)]).collect::<Vec<_>>());
}

#[test]
fn the_interval_of_a_difference_covers_it() {
    let [a, b] = &built_in(32, 10)[..] else { panic!("two predictions") };
    let comparison =
        svbrdf_core::loss::Comparison::new(&a.ground_truth, &[&a.prediction, &b.prediction], PRINTED)
            .unwrap();
    let expected = a.reference - b.reference;
    let held = (0..MORE_SEEDS).into_par_iter().filter(|&seed| {
        let request = Request::Scenes(Sampling { seed, ..Sampling::default() });
        let outcome = comparison.run(&request, &Progress::default()).unwrap();
        holds(&outcome.difference(0, 1), expected)
    });
    let coverage = 100.0 * held.count() as f64 / MORE_SEEDS as f64;
    println!("{coverage}%");
    assert!(covers(MORE_SEEDS, coverage), "{coverage}%");
}

#[test]
fn intervals_that_are_too_narrow_or_too_wide_are_seen() {
    let pair = &made(8, 10)[0];
    for factor in [0.7, 1.4] {
        let estimate = pair.fixed(Sampler::Random, Texels::All, 9);
        let seen = pair.seen(MORE_SEEDS, |seed| {
            let (e, count) = estimate(seed);
            let scaled = e.interval95.map(|interval| interval.map(|x| e.mean + factor * (x - e.mean)));
            (Estimate { interval95: scaled, ..e }, count)
        });
        assert!(!covers(MORE_SEEDS, seen.coverage), "{factor}: {seen:?}");
    }
}

#[test]
fn the_scenes_alone_do_not_tell_how_heavy_their_tail_is() {
    let pair = &made(16, 9)[2];
    let seen = pair.seen(MORE_SEEDS, |seed| {
        let request = Request::Scenes(Sampling { near: 18, distant: 9, seed, ..Sampling::default() });
        let outcome = pair.comparison().without_pilot().run(&request, &Progress::default()).unwrap();
        (outcome.losses[0].estimate, 27)
    });
    assert!(!covers(MORE_SEEDS, seen.coverage), "{seen:?}");
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
    let seen = pair.seen(MORE_SEEDS, pair.adaptive(0.05));
    println!("{seen:?}");
    assert!(covers(MORE_SEEDS, seen.coverage) && seen.half_width <= 5.0, "{seen:?}");
    assert!(seen.bias.abs() < 4.0 * seen.bias_error, "{seen:?}");
}
