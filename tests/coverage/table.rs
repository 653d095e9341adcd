//! The whole table of coverages: minutes to an hour, ignored unless asked for.

use svbrdf_core::loss::{Estimate, TEXELS, Texels};
use svbrdf_core::model::sampler::Sampler;

use super::measured::{ALLOWED, PROMISED, Pair, Seen, built_in, golden, made};

const SEEDS: u64 = 2_000;
/// The coverage of 2,000 seeds has a standard error of 0.5%: a cell outside the bounds is decided by more.
const MORE_SEEDS: u64 = 8_000;
const SAMPLERS: [Sampler; 2] = [Sampler::Random, Sampler::Sobol];

/// What has been seen, and what of it is wrong.
#[derive(Default)]
struct Table(Vec<String>);

impl Table {
    /// Prints a cell, and remembers it where the coverage is outside, or the mean is off by more than `bias` percent and four standard
    /// errors.
    fn measure(
        &mut self,
        pair: &Pair,
        what: &str,
        [least, most]: [f64; 2],
        bias: f64,
        estimate: impl Fn(u64) -> (Estimate, usize) + Sync + Send,
    ) {
        let is_right = |seen: &Seen| {
            let error = seen.bias_error.hypot(pair.reference_error);
            (least..=most).contains(&seen.coverage) && seen.bias.abs() <= bias + 4.0 * error
        };
        let (mut seeds, mut seen) = (SEEDS, pair.seen(SEEDS, &estimate));
        if !is_right(&seen) {
            println!("more seeds for {}, {what}: {seen:.3?}", pair.name());
            (seeds, seen) = (MORE_SEEDS, pair.seen(MORE_SEEDS, &estimate));
        }
        let line = format!("{}, {what}, {seeds} seeds: {seen:.3?}", pair.name());
        println!("{}{line}", if is_right(&seen) { "" } else { "WRONG: " });
        if !is_right(&seen) {
            self.0.push(line);
        }
    }

    fn check(&self) {
        assert!(self.0.is_empty(), "{}", self.0.join("\n"));
    }
}

#[test]
#[ignore = "half an hour: a table of coverages, see above"]
fn coverage_of_all_texels() {
    let mut table = Table::default();
    for pair in made(16, 13).into_iter().chain(built_in(16, 13)).chain(golden(16, 13)) {
        for sampler in SAMPLERS {
            for count in [9, 27, 90, 900] {
                let what = format!("{sampler} {count}, 16 x 16");
                table.measure(&pair, &what, ALLOWED, 0.0, pair.fixed(sampler, Texels::All, count));
            }
        }
    }
    table.check();
}

/// Here the pilot compares fewer texels than the request.
#[test]
#[ignore = "minutes: a table of coverages, see above"]
fn coverage_of_larger_maps() {
    let mut table = Table::default();
    let foam = golden(64, 13).into_iter().filter(|pair| pair.ground_truth.name().contains("foam"));
    for pair in made(64, 10).into_iter().chain(built_in(4, 10)).chain(foam) {
        for sampler in SAMPLERS {
            for count in [9, 27] {
                let what = format!("{sampler} {count}, 64 x 64");
                table.measure(&pair, &what, ALLOWED, 0.0, pair.fixed(sampler, Texels::All, count));
            }
        }
    }
    table.check();
}

#[test]
#[ignore = "an hour: a table of coverages, see above"]
fn coverage_of_some_texels() {
    let mut table = Table::default();
    let counts = [9, 27, 90, 900];
    let texels = Texels::Sampled(TEXELS);
    // A pair that differs in a single texel needs a reference of many scenes.
    for (pairs, counts) in
        [(made(64, 13), counts.as_slice()), (built_in(4, 11), &counts), (golden(64, 11), &[9, 90])]
    {
        for (pair, sampler) in pairs.iter().flat_map(|pair| SAMPLERS.map(|sampler| (pair, sampler))) {
            for &count in counts {
                let what = format!("{sampler} {count}, {texels} texels of 64 x 64");
                table.measure(pair, &what, ALLOWED, 0.0, pair.fixed(sampler, texels, count));
            }
        }
    }
    table.check();
}

#[test]
#[ignore = "an hour: a table of coverages, see above"]
fn coverage_of_adaptive_losses() {
    let mut table = Table::default();
    for pair in made(64, 12).into_iter().chain(built_in(4, 12)).chain(golden(64, 12)) {
        for target in [0.03, 0.01] {
            // A twentieth of the accuracy, in percent: to go on where it is missed makes losses low.
            let bias = 100.0 * target / 20.0;
            table.measure(&pair, &format!("accuracy {target}"), PROMISED, bias, pair.adaptive(target));
        }
    }
    table.check();
}
