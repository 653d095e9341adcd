//! The whole table of coverages: minutes to an hour, ignored unless asked for.

use svbrdf::loss::{TEXELS, Texels};
use svbrdf::model::sampler::Sampler;

use super::measured::{ALLOWED, PROMISED, Pair, Seen, built_in, golden, made};

const SEEDS: u64 = 2_000;
const SAMPLERS: [Sampler; 2] = [Sampler::Random, Sampler::Sobol];

/// What has been seen, and what of it is wrong.
#[derive(Default)]
struct Table(Vec<String>);

impl Table {
    fn note(&mut self, pair: &Pair, what: &str, [least, most]: [f64; 2], seen: Seen) {
        let line = format!("{}, {what}: {seen:.3?}", pair.name());
        let is_right = (least..=most).contains(&seen.coverage) && seen.bias.abs() <= 4.0 * seen.bias_error;
        println!("{}{line}", if is_right { "" } else { "WRONG: " });
        if !is_right {
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
                let seen = pair.seen(SEEDS, pair.fixed(sampler, Texels::All, count));
                table.note(&pair, &format!("{sampler} {count}, 16 x 16"), ALLOWED, seen);
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
                let seen = pair.seen(SEEDS, pair.fixed(sampler, Texels::All, count));
                table.note(&pair, &format!("{sampler} {count}, 64 x 64"), ALLOWED, seen);
            }
        }
    }
    table.check();
}

#[test]
#[ignore = "an hour: a table of coverages, see above"]
fn coverage_of_some_texels() {
    let mut table = Table::default();
    for pair in made(64, 11).into_iter().chain(built_in(4, 11)).chain(golden(64, 11)) {
        for sampler in SAMPLERS {
            let texels = Texels::Sampled(TEXELS);
            for count in [9, 27, 90, 900] {
                let seen = pair.seen(SEEDS, pair.fixed(sampler, texels, count));
                table.note(&pair, &format!("{sampler} {count}, {texels} texels of 64 x 64"), ALLOWED, seen);
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
            let seen = pair.seen(SEEDS, pair.adaptive(target));
            table.note(&pair, &format!("accuracy {target}"), PROMISED, seen);
        }
    }
    table.check();
}
