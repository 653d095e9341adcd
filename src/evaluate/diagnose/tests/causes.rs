//! Causes that users meet: what is said of each is the whole of it.

use super::super::{Diagnosis, Hypothesis, Placement, Reading, Storage, diagnose, sentence, shifted};
use super::materials::{generated, with};
use svbrdf_core::material::Material;
use svbrdf_core::model::convention::PRINTED;
use svbrdf_core::progress::Progress;
use svbrdf_files::read::Albedo;

fn found(truth: &Material<f32>, prediction: &Material<f32>, storages: [&Storage; 2]) -> Diagnosis {
    diagnose([truth, prediction], storages, &PRINTED, 0.0, 1, &Progress::default()).unwrap()
}

fn marked(found: &Diagnosis) -> Vec<(Hypothesis, f64)> {
    found.marked().map(|one| (one.hypothesis, one.share)).collect()
}

/// A ground truth that is stored in sRGB and read as linear, against what is right: no exposure stands for the whole cause.
#[test]
fn the_cause_that_explains_most_is_the_first_or_is_said_to_explain_more() {
    let of = |encoding| Storage { colours: Some(encoding), specular: Some(encoding), ..Storage::default() };
    let [linear, encoded] = [Albedo::Linear, Albedo::Srgb].map(of);
    for seed in 0..6 {
        let right = generated(seed, 48);
        let wrong = Reading::Colours(Albedo::Linear).applied(&right, &encoded).unwrap();
        for storage in [&linear, &encoded] {
            let found = found(&wrong, &right, [&linear, storage]);
            let text = sentence(&found, None);
            let (first, most) = (marked(&found)[0], found.findings.iter().map(|one| one.share));
            let is_first = first.1 >= most.fold(0.0, f64::max) - 0.01;
            assert!(is_first || text.contains("explains more"), "{seed}: {text} {found:#?}");
        }
    }
}

/// All else is equal, so that no file is read wrongly.
#[test]
fn a_factor_on_a_map_is_no_reading() {
    let unknown = Storage::default();
    let encoded =
        Storage { colours: Some(Albedo::Srgb), specular: Some(Albedo::Linear), ..Storage::default() };
    for (seed, factor, specular, storage) in [
        (0, 0.4, true, &encoded),
        (1, 0.4, true, &unknown),
        (4, 0.7, true, &encoded),
        (0, 0.4, false, &unknown),
        (1, 0.4, false, &encoded),
    ] {
        let truth = generated(seed, 48);
        let other = with(&truth, |planes| {
            let map = if specular { &mut planes.specular } else { &mut planes.diffuse };
            map.iter_mut().flatten().for_each(|value| *value = (*value * factor).min(1.0));
        });
        let found = found(&truth, &other, [storage; 2]);
        let hypothesis = if specular { Hypothesis::SpecularFactor } else { Hypothesis::DiffuseFactor };
        let marked = marked(&found);
        let is_right = marked.len() == 1 && marked[0].0 == hypothesis && marked[0].1 > 0.95;
        // A dielectric of little diffuse is darker in any case.
        let is_exposure = !specular && marked.len() == 1 && marked[0].0 == Hypothesis::Exposure;
        let text = sentence(&found, None);
        assert!(is_right || is_exposure, "{seed}: {text} {found:#?}");
    }
}

/// The part of a generated material in which a prediction lies on its ground truth as `placement` says.
fn placed(seed: u64, side: usize, placement: Placement) -> [Material<f32>; 2] {
    // Both are seen through a finer grid, so that neither is blurred alone.
    let fine = generated(seed, 3 * side);
    let apart = Placement { by: placement.by.map(|by| 2.0 * by), ..placement };
    [fine.clone(), apart.inverse().applied(&fine).unwrap()].map(|one| {
        let from = side / 2;
        let texels: Vec<usize> = (0..4 * side * side)
            .map(|i| (from + i / (2 * side)) * 3 * side + from + i % (2 * side))
            .collect();
        one.gathered(&texels, [2 * side; 2]).resized([side; 2]).unwrap()
    })
}

#[test]
fn scales_crops_and_parts_of_a_texel_are_found() {
    for (seed, scale, by) in [
        (0, 1.01, [0.0, 0.0]),
        (1, 0.97, [0.0, 0.0]),
        (2, 1.125, [0.0, 0.0]),
        (3, 288.0 / 256.0, [0.0, 0.0]),
        (4, 256.0 / 288.0, [0.0, 0.0]),
        (5, 1.0, [0.5, 0.5]),
        (0, 1.0, [0.5, 0.0]),
        (1, 1.05, [3.0, -2.25]),
        (2, 0.9, [-1.5, 0.5]),
    ] {
        let placement = Placement { scale, by };
        let [truth, prediction] = placed(seed, 96, placement);
        let found = found(&truth, &prediction, [&Storage::default(); 2]);
        let marked = marked(&found);
        let text = sentence(&found, None);
        let is_found = marked.first().is_some_and(|one| one.0 == Hypothesis::Placement);
        println!("{placement:?}: {marked:?} {text}");
        assert!(is_found && marked.len() == 1, "{placement:?}: {text} {found:#?}");
    }
}

#[test]
fn displacements_are_found_up_to_a_quarter_of_a_side() {
    for (seed, side, by) in [(0, 48, [9, 0]), (1, 64, [12, -3]), (2, 64, [-15, 14]), (4, 128, [0, 31])] {
        let truth = generated(seed, side);
        let found = found(&truth, &shifted(&truth, by), [&Storage::default(); 2]);
        let text = sentence(&found, None);
        let finding = found.marked().next();
        let is_exact = finding.is_some_and(|one| one.hypothesis == Hypothesis::Shift && one.share > 0.999);
        assert!(is_exact && found.marked().count() == 1, "{by:?}: {text} {found:#?}");
    }
}
