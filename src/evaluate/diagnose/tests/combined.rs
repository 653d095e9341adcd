//! Two to four errors at once: the marked changes are made, round by round, until nothing is marked.

use rand::rngs::ChaCha8Rng;
use rand::seq::{IndexedRandom as _, SliceRandom as _};
use rand::{RngExt as _, SeedableRng as _};

use super::super::corrected::Corrected;
use super::super::samples::Pair;
use super::super::{Change, Reading, Storage, Symmetry, diagnose, floor};
use super::materials::generated;
use svbrdf_core::loss::{Comparison, Request, Sampling};
use svbrdf_core::material::Material;
use svbrdf_core::model::convention::PRINTED;
use svbrdf_core::model::sampler::Sampler;
use svbrdf_core::progress::Progress;
use svbrdf_files::read::Albedo;

const SIDE: usize = 64;
const LINEAR: Albedo = Albedo::Linear;

/// Errors of normals, roughness, colours, places and brightness: a pair has at most one of each.
const ERRORS: [&[Change]; 5] = [
    &[Change::Reading(Reading::NormalY), Change::Reading(Reading::NormalX)],
    &[
        Change::Reading(Reading::Gloss),
        Change::Reading(Reading::SquaredRoughness),
        Change::Reading(Reading::RootOfRoughness),
        Change::GroundTruth(Reading::Gloss),
    ],
    &[
        Change::Reading(Reading::Colours(LINEAR)),
        Change::Reading(Reading::Diffuse(LINEAR)),
        Change::Reading(Reading::Specular(LINEAR)),
        Change::Reading(Reading::RedBlue),
    ],
    &[
        Change::Shift([3, -2]),
        Change::Shift([-4, 1]),
        Change::Symmetry(Symmetry::ALL[0]),
        Change::Symmetry(Symmetry::ALL[4]),
    ],
    // Brighter ones would clip metals, which no change undoes.
    &[Change::Exposure([-0.5; 3]), Change::Exposure([-1.0; 3])],
];

/// The storage after a reading that is made.
fn read_as(storage: &mut Storage, reading: Reading) {
    match reading {
        Reading::Colours(to) => (storage.colours, storage.specular) = (Some(to), Some(to)),
        Reading::Diffuse(to) => storage.colours = Some(to),
        Reading::Specular(to) => storage.specular = Some(to),
        Reading::NormalY => storage.normal_down = !storage.normal_down,
        Reading::Unscaled | Reading::Scaled => storage.unscaled = reading == Reading::Unscaled,
        _ => {}
    }
}

/// Makes changes of a pair, an exposure as a factor on both colours.
fn made(pair: &mut [Material<f32>; 2], storages: &mut [Storage; 2], changes: &[Change]) {
    let of = Pair { ground_truth: &pair[0], prediction: &pair[1], storages: storages.each_ref() };
    let corrected = Corrected::new(&of, None, changes).unwrap();
    let truth = corrected.ground_truth.unwrap_or_else(|| pair[0].clone());
    *pair = [truth, corrected.material];
    for change in changes {
        match *change {
            Change::Reading(reading) => read_as(&mut storages[1], reading),
            Change::GroundTruth(reading) => read_as(&mut storages[0], reading),
            Change::Exposure([stops, ..]) => {
                for factor in [Change::DiffuseFactor(stops.exp2()), Change::SpecularFactor(stops.exp2())] {
                    pair[1] = factor.of_values(&pair[1], &storages[1]).unwrap();
                }
            }
            _ => {}
        }
    }
}

fn loss([truth, prediction]: &[Material<f32>; 2]) -> f64 {
    let sampling =
        Sampling { near: 128, distant: 64, seed: 9, sampler: Sampler::Sobol, ..Sampling::default() };
    let comparison = Comparison::new(truth, &[prediction], PRINTED).unwrap().without_pilot();
    comparison.run(&Request::Scenes(sampling), &Progress::default()).unwrap().losses[0].estimate.mean
}

fn short(rounds: &[Vec<Change>]) -> String {
    let round = |round: &Vec<Change>| round.iter().map(ToString::to_string).collect::<Vec<_>>().join(", ");
    rounds.iter().map(round).collect::<Vec<_>>().join(" | ")
}

#[test]
#[ignore = "takes minutes; docs/verification.md has its command and its result"]
fn marked_changes_of_two_to_four_errors_end_at_the_floor() {
    let mut generator = ChaCha8Rng::seed_from_u64(5);
    let mut ended = [[0; 2]; 3];
    for number in 0..80 {
        let truth = generated(number % 5, SIDE);
        let count = generator.random_range(2..=4);
        let mut kinds = ERRORS;
        kinds.shuffle(&mut generator);
        let planted: Vec<Change> =
            kinds[..count].iter().map(|kind| *kind.choose(&mut generator).unwrap()).collect();
        let stored =
            Storage { colours: Some(Albedo::Srgb), specular: Some(Albedo::Srgb), ..Storage::default() };
        let floor = floor(&truth, &stored, &PRINTED, 1, &Progress::default()).unwrap().mean;
        let (mut pair, mut storages) = ([truth.clone(), truth], [stored.clone(), stored]);
        // As predictions are wrong: darker, then stored and read in another way.
        let (exposures, others): (Vec<_>, Vec<_>) =
            planted.iter().partition(|one| matches!(one, Change::Exposure(_)));
        made(&mut pair, &mut storages, &exposures);
        made(&mut pair, &mut storages, &others);
        let (before, mut rounds) = (loss(&pair), Vec::new());
        for seed in 0..6 {
            let [truth, prediction] = pair.each_ref();
            let found = diagnose(
                [truth, prediction],
                storages.each_ref(),
                &PRINTED,
                floor,
                seed,
                &Progress::default(),
            );
            let changes: Vec<Change> = found.unwrap().marked().filter_map(|one| one.change).collect();
            if changes.is_empty() {
                break;
            }
            made(&mut pair, &mut storages, &changes);
            rounds.push(changes);
        }
        let after = loss(&pair);
        let [at_end, all] = &mut ended[count - 2];
        *at_end += usize::from(after <= floor);
        *all += 1;
        let mark = if after <= floor { "" } else { "MISSED " };
        println!(
            "{mark}{number} {}: {before:.4} to {after:.4}, floor {floor:.4} {}",
            short(&[planted]),
            short(&rounds)
        );
    }
    println!("of two, three and four errors, at the floor of all: {ended:?}");
    assert!(ended.iter().map(|[at_end, _]| at_end).sum::<usize>() >= 73, "{ended:?}");
}
