//! Each error planted alone: it is found with its value, and the rest of the table stays unmarked.

use super::super::alignment::{Alignments, Interior};
use super::super::{
    Diagnosis, Explained, Hypothesis, Placement, Reading, Storage, Symmetry, Value, diagnose, sentence,
    shifted,
};
use super::materials::{generated, unexplained, with};
use svbrdf_core::loss::{Comparison, Compute as _};
use svbrdf_core::material::Material;
use svbrdf_core::model::brdf::Texel;
use svbrdf_core::model::convention::PRINTED;
use svbrdf_core::model::sampler::Sampler;
use svbrdf_core::progress::Progress;
use svbrdf_files::read::Albedo;

const SIDE: usize = 48;

/// Colours that are stored in an encoding.
fn stored(encoding: Albedo) -> Storage {
    Storage { colours: Some(encoding), specular: Some(encoding), ..Storage::default() }
}

/// The diagnosis, whose sentence is there before the lines without a mark.
fn found(truth: &Material<f32>, prediction: &Material<f32>, storage: &Storage) -> Diagnosis {
    let (pair, progress) = ([truth, prediction], Progress::default());
    let explained = Explained::of(pair, [storage; 2], &PRINTED, 0.0, 1, &progress).unwrap();
    let marked = explained.marked();
    let found = explained.with_all_lines().unwrap();
    assert_eq!(sentence(&marked, None), sentence(&found, None));
    assert!(marked.findings.iter().all(|finding| finding.marked), "{marked:#?}");
    assert_eq!(found.findings.len(), Hypothesis::of(storage).count());
    found
}

/// The only marked finding.
#[track_caller]
fn only(diagnosis: &Diagnosis) -> (Hypothesis, Value) {
    let marked: Vec<_> = diagnosis.marked().collect();
    assert!(marked.len() == 1, "{diagnosis:#?}");
    (marked[0].hypothesis, marked[0].value.clone())
}

#[test]
fn shifts() {
    for (seed, shift) in [(0, [3, -2]), (1, [-8, 8]), (2, [0, 1])] {
        let truth = generated(seed, SIDE);
        let found = found(&truth, &shifted(&truth, shift), &Storage::default());
        assert_eq!(only(&found), (Hypothesis::Shift, Value::Displacement(shift.map(f64::from))));
        let finding = found.marked().next().unwrap();
        assert!(finding.loss < 1e-6 && finding.share > 0.999, "{finding:?}");
    }
}

/// A regular subset of the texels of a shift would have been 16 columns of these maps.
#[test]
fn the_share_of_a_shift_is_that_of_all_texels() {
    let side = 512;
    let truth = generated(0, side);
    let moved = with(&shifted(&truth, [2, 0]), |planes| {
        let between_columns = |index: usize| (8..24).contains(&(index % side % 32));
        let roughness = planes.roughness.iter_mut().enumerate().filter(|(index, _)| between_columns(*index));
        roughness.for_each(|(_, roughness)| *roughness *= 0.8);
    });
    let found = found(&truth, &moved, &Storage::default());
    let finding = found.findings.iter().find(|finding| finding.hypothesis == Hypothesis::Shift).unwrap();
    assert_eq!(finding.value, Value::Displacement([2.0, 0.0]));

    let back = shifted(&moved, [-2, 0]);
    let predictions = [&moved, &back];
    let comparison = Comparison::new(&truth, &predictions, PRINTED).unwrap();
    let scenes = Sampler::Sobol.scenes(1, 64, 32, &PRINTED);
    let texels = Interior::new([side; 2], Placement::moved([2, 0])).texels();
    let losses = f32::cpu().scene_losses(&comparison, &scenes, Some(&texels), &Progress::default()).unwrap();
    let [before, after] = [0, 1].map(|of: usize| losses[of].iter().sum::<f64>());
    let (share, expected) = (finding.share, 1.0 - after / before);
    assert!((share - expected).abs() < 0.005 && expected < 0.99, "{share}, of all texels {expected}");
}

#[test]
fn maps_of_one_texel_on_a_side_are_diagnosed() {
    for [width, height] in [[1, 1], [1, 5], [7, 1]] {
        let uniform = |roughness| {
            let texel = Texel { normal: glam::Vec3::Z, diffuse: [0.5; 3], specular: [0.04; 3], roughness };
            Material::uniform("uniform", width, height, &texel).unwrap()
        };
        let found = found(&uniform(0.5), &uniform(0.6), &Storage::default());
        assert!(
            found.loss.mean > 0.0
                && found.findings.iter().all(|one| one.hypothesis != Hypothesis::Shift || !one.marked)
        );
    }
}

#[test]
fn symmetries() {
    for (seed, symmetry) in [0, 1, 2].into_iter().flat_map(|seed| Symmetry::ALL.map(|s| (seed, s))) {
        if seed > 0 && symmetry != Symmetry::ALL[seed as usize * 3] {
            continue;
        }
        let truth = generated(seed, SIDE);
        let moved = symmetry.inverse().applied(&truth).unwrap();
        let found = found(&truth, &moved, &Storage::default());
        assert_eq!(only(&found), (Hypothesis::Symmetry, Value::Name(symmetry.name())));
    }
}

#[test]
fn readings() {
    let linear = stored(Albedo::Linear);
    let planted = [
        (Reading::NormalY, Reading::NormalY, Hypothesis::NormalY, Some("normal-y=down")),
        (Reading::NormalX, Reading::NormalX, Hypothesis::NormalX, None),
        (Reading::Gloss, Reading::Gloss, Hypothesis::Roughness, Some("roughness=gloss")),
        (Reading::SquaredRoughness, Reading::RootOfRoughness, Hypothesis::Roughness, Some("roughness=alpha")),
        (Reading::RootOfRoughness, Reading::SquaredRoughness, Hypothesis::Roughness, None),
        (Reading::RedBlue, Reading::RedBlue, Hypothesis::Channels, None),
        (Reading::Scaled, Reading::Unscaled, Hypothesis::Energy, Some("energy=unscaled")),
    ];
    for seed in 0..3 {
        let truth = generated(seed, SIDE);
        for (error, correction, hypothesis, remedy) in planted {
            // Metals have little diffuse to scale, and dielectrics are hardly scaled.
            if hypothesis == Hypothesis::Energy && seed != 1 {
                continue;
            }
            let found = found(&truth, &error.applied(&truth, &linear).unwrap(), &linear);
            assert_eq!(only(&found), (hypothesis, Value::Name(correction.name())), "material {seed}");
            let found = found.marked().next().unwrap().remedy.map(|remedy| remedy.words());
            assert_eq!(found.as_deref(), remedy);
        }
    }
}

#[test]
fn encodings_of_colours() {
    let [linear, encoded] = [Albedo::Linear, Albedo::Srgb].map(stored);
    for seed in 0..3 {
        let truth = generated(seed, SIDE);
        for (read_as, error, name) in [(&linear, Albedo::Linear, "srgb"), (&encoded, Albedo::Srgb, "linear")]
        {
            // What was stored in the other encoding and read as this one.
            let other = if error == Albedo::Linear { &encoded } else { &linear };
            let wrong = Reading::Colours(error).applied(&truth, other).unwrap();
            let found = found(&truth, &wrong, read_as);
            assert_eq!(only(&found), (Hypothesis::AlbedoEncoding, Value::Name(name)), "material {seed}");
            let remedy = found.marked().next().unwrap().remedy.map(|remedy| remedy.words());
            assert_eq!(remedy, Some(format!("albedo={name},specular-albedo={name}")));
        }
    }
}

/// Where specular is 0, radiance is that of diffuse but for Fresnel at grazing angles.
#[test]
fn exposures() {
    for (seed, stops) in [(0, -0.7_f64), (2, 0.4), (5, -1.5)] {
        let matte = |material: &Material<f32>, factor: f32| {
            with(material, |planes| {
                planes.specular.iter_mut().flatten().for_each(|s| *s = 0.0);
                planes.roughness.iter_mut().for_each(|r| *r = 1.0);
                planes.diffuse.iter_mut().flatten().for_each(|d| *d *= 0.6 * factor);
            })
        };
        let truth = generated(seed, SIDE);
        let found = found(&matte(&truth, 1.0), &matte(&truth, stops.exp2() as f32), &Storage::default());
        let (hypothesis, value) = only(&found);
        let Value::Number(value) = value else { panic!("{value:?}") };
        assert!(hypothesis == Hypothesis::Exposure && (value + stops).abs() < 0.01, "{value} {stops}");
    }
}

#[test]
fn nothing_is_marked_without_an_error_or_with_others() {
    let truth = generated(3, SIDE);
    let same = found(&truth, &truth, &Storage::default());
    assert!(same.marked().next().is_none() && same.loss.mean == 0.0);
    assert_eq!(sentence(&same, None), "The prediction equals the ground truth.");
    for storage in [Storage::default(), Storage { base_colour: true, ..Storage::default() }] {
        let found = found(&truth, &truth, &storage);
        let lines: Vec<_> = found.findings.iter().map(|finding| finding.hypothesis).collect();
        assert_eq!(lines, Hypothesis::of(&storage).collect::<Vec<_>>());
    }
    for seed in 0..4 {
        let found = found(&truth, &unexplained(&truth, seed), &Storage::default());
        assert!(found.marked().next().is_none(), "{found:#?}");
        assert!(
            sentence(&found, None).starts_with("No exposure, displacement"),
            "{}",
            sentence(&found, None)
        );
    }
}

#[test]
fn two_errors_are_found_at_once() {
    let truth = generated(0, SIDE);
    let encoded = stored(Albedo::Srgb);
    let read_as_linear = stored(Albedo::Linear);
    let flipped = Reading::NormalY.applied(&truth, &encoded).unwrap();
    let both = Reading::Colours(Albedo::Linear).applied(&flipped, &encoded).unwrap();
    let found = found(&truth, &both, &read_as_linear);
    let marked: Vec<_> = found.marked().map(|finding| finding.hypothesis).collect();
    assert_eq!(marked, [Hypothesis::AlbedoEncoding, Hypothesis::NormalY]);
}

/// A quarter of the rows, every fourth one, is displaced otherwise: a regular subset of 64 rows of these maps would have been this quarter.
#[test]
fn a_shift_is_that_of_most_rows() {
    let (side, columns) = (272, 272);
    let truth = generated(0, side);
    let [mut moved, other] = [[2, 0], [5, 0]].map(|shift| shifted(&truth, shift));
    moved = with(&moved, |planes| {
        let from = other.planes();
        let maps = [&mut planes.normal, &mut planes.diffuse, &mut planes.specular];
        let others = [&from.normal, &from.diffuse, &from.specular];
        let planes = maps.into_iter().flatten().chain([&mut planes.roughness]);
        let others = others.into_iter().flatten().chain([&from.roughness]);
        for (plane, other) in planes.zip(others) {
            let rows = plane.chunks_mut(columns).zip(other.chunks(columns)).step_by(4);
            rows.for_each(|(row, other)| row.copy_from_slice(other));
        }
    });
    let found = Alignments::of([&truth, &moved], 1).unwrap().shifts;
    assert!(found.contains(&[2, 0]), "{found:?}");
}

/// Diffuse and specular are stored in sRGB; one of them, or one of those of the ground truth, is read as linear.
#[test]
fn a_map_in_another_encoding_is_found_alone_and_on_either_side() {
    let encoded = stored(Albedo::Srgb);
    let [diffuse, specular] = [Reading::Diffuse(Albedo::Linear), Reading::Specular(Albedo::Linear)];
    let wrong_diffuse = Storage { colours: Some(Albedo::Linear), ..encoded.clone() };
    let wrong_specular = Storage { specular: Some(Albedo::Linear), ..encoded.clone() };
    for (seed, error, read_as, hypothesis, remedy) in [
        (0, diffuse, &wrong_diffuse, Hypothesis::DiffuseEncoding, "albedo=srgb,specular-albedo=srgb"),
        (2, diffuse, &wrong_diffuse, Hypothesis::DiffuseEncoding, "albedo=srgb,specular-albedo=srgb"),
        (1, specular, &wrong_specular, Hypothesis::SpecularEncoding, "specular-albedo=srgb"),
    ] {
        let truth = generated(seed, SIDE);
        let wrong = error.applied(&truth, &encoded).unwrap();
        let of_prediction = found(&truth, &wrong, read_as);
        assert_eq!(only(&of_prediction), (hypothesis, Value::Name("srgb")), "material {seed}");
        // The ground truth is read wrongly, and noise tells that the prediction is not.
        let pair = [&wrong, &truth];
        let of_truth = diagnose(pair, [read_as, &encoded], &PRINTED, 0.0, 1, &Progress::default()).unwrap();
        let marked: Vec<_> = of_truth.marked().collect();
        assert!(marked.len() == 1 && marked[0].share > 0.99, "{marked:#?}");
        let option = marked[0].command_option(["gt", "ours"]);
        let text = sentence(&of_truth, None);
        let names_truth = option.as_ref().is_some_and(|option| *option == format!("--read gt:{remedy}"));
        assert!(
            names_truth || text.contains("probably") && text.contains("ground truth"),
            "{text} {option:?}"
        );
    }
}

#[test]
fn nothing_is_marked_below_the_floor() {
    let truth = generated(0, SIDE);
    let flipped = Reading::NormalY.applied(&truth, &Storage::default()).unwrap();
    let marks = |floor: f64| {
        let found =
            diagnose([&truth, &flipped], [&Storage::default(); 2], &PRINTED, floor, 1, &Progress::default());
        let found = found.unwrap();
        (found.marked().count(), found.loss.mean)
    };
    let (count, loss) = marks(0.0);
    assert_eq!(count, 1);
    assert_eq!([marks(0.5 * loss).0, marks(1.1 * loss).0], [1, 0]);
}

/// What is left is noise: no exposure is named without "probably", and a cause that either side may have is not, either.
#[test]
fn a_cause_is_certain_only_where_nothing_else_explains_as_much() {
    let truth = generated(0, SIDE);
    let linear = stored(Albedo::Linear);
    let text =
        |error: Reading| sentence(&found(&truth, &error.applied(&truth, &linear).unwrap(), &linear), None);
    let gloss = text(Reading::Gloss);
    assert!(
        gloss.contains("the file probably holds glossiness. Another change that explains as much"),
        "{gloss}"
    );
    let x = text(Reading::NormalX);
    assert!(x.contains("No option corrects this reading"), "{x}");
    let swapped = text(Reading::RedBlue);
    assert!(swapped.contains("No option corrects this reading"), "{swapped}");
}

/// Factors on three channels imitate swapped channels and an exposure: both are found.
#[test]
fn swapped_and_darker_channels_are_no_white_balance() {
    let (truth, encoded) = (generated(2, 64), stored(Albedo::Srgb));
    let darker = with(&Reading::RedBlue.applied(&truth, &encoded).unwrap(), |planes| {
        let colours = planes.diffuse.iter_mut().chain(&mut planes.specular).flatten();
        colours.for_each(|value| *value = (*value * (-0.5_f32).exp2()).min(1.0));
    });
    let found = diagnose([&truth, &darker], [&encoded; 2], &PRINTED, 0.0048, 0, &Progress::default());
    let found = found.unwrap();
    let marked: Vec<_> = found.marked().map(|one| (one.hypothesis, one.value.to_string())).collect();
    let expected = [(Hypothesis::Exposure, "0.47"), (Hypothesis::Channels, "swapped")];
    assert_eq!(marked, expected.map(|(hypothesis, value)| (hypothesis, value.to_owned())));
    assert!(found.explained.is_some_and(|explained| explained > 0.96), "{found:?}");
}
