//! The study: its errors, against an independent reckoning.

use std::sync::LazyLock;

use svbrdf_core::loss::{Comparison, Plain, Request, Sampling};
use svbrdf_core::material::Material;
use svbrdf_core::model::convention::PRINTED;
use svbrdf_core::progress::Progress;
use svbrdf_evaluate::Error;
use svbrdf_evaluate::study::{self, Choice, Family, Pair, Point, Reference, Study};
use svbrdf_files::read;
use svbrdf_files::read::Preset;
use svbrdf_files::samples;
use svbrdf_files::write::{self, Depth, FileKind};

use crate::support::fixtures::LINEAR;
use crate::support::tolerance::{STUDY_ERROR, STUDY_REFERENCE, STUDY_SHIFT};

/// The built-in ground truth and its first prediction, 12 texels wide.
fn materials() -> [Material<f32>; 2] {
    let samples = samples::load::<f32>().unwrap();
    let [prediction, _] = samples.predictions.try_into().unwrap();
    [samples.ground_truth, prediction].map(|read| read.material.resized([12, 12]).unwrap())
}

fn run([ground_truth, prediction]: &[Material<f32>; 2], progress: &Progress) -> Result<Study, Error> {
    study::run(&Pair { ground_truth, prediction, convention: PRINTED }, progress, |_| ())
}

/// The study of [`materials`], which the tests share.
fn studied() -> &'static Study {
    static STUDY: LazyLock<Study> = LazyLock::new(|| run(&materials(), &Progress::default()).unwrap());
    &STUDY
}

/// The loss of `choice` over the scenes of a seed, by the plain f64 kernel.
fn plain_loss([ground_truth, prediction]: &[Material<f32>; 2], choice: &Choice, seed: u64) -> f64 {
    let [ground_truth, prediction]: [Material<f64>; 2] = [ground_truth.cast(), prediction.cast()];
    let Choice { sampler, texels, .. } = *choice;
    let sampling = Sampling { near: choice.near(), distant: choice.distant(), seed, sampler, texels };
    let comparison = Comparison::new(&ground_truth, &[&prediction], PRINTED).unwrap().on(&Plain);
    comparison.run(&Request::Scenes(sampling), &Progress::default()).unwrap().losses[0].estimate.mean
}

fn point(study: &Study, family: Family, scenes: usize) -> Point {
    let is = |p: &&Point| p.choice.family() == family && p.choice.scenes == scenes;
    *study.points.iter().find(is).unwrap()
}

/// The error as its definition has it, of the plain f64 loss over the seeds from `first` on.
fn reckoned(materials: &[Material<f32>; 2], study: &Study, point: &Point, first: u64) -> f64 {
    let of_seed = |seed| {
        let loss = plain_loss(materials, &point.choice, first + seed);
        loss / study.reference.loss - 1.0
    };
    ((0..point.seeds as u64).map(|seed| of_seed(seed).powi(2)).sum::<f64>() / point.seeds as f64).sqrt()
}

#[test]
fn errors_are_those_of_plain_losses_over_the_same_seeds() {
    let materials = materials();
    let study = studied();
    for (family, scenes) in [
        (Family::Random, 9),
        (Family::Random, 90),
        (Family::Sobol, 24),
        (Family::FewTexels, 96),
        (Family::F64, 48),
    ] {
        let point = point(study, family, scenes);
        let expected = reckoned(&materials, study, &point, 0);
        let close = |want: f64| (point.error / want - 1.0).abs() < STUDY_ERROR;
        assert!(close(expected), "{family:?} {scenes}: {} is not {expected}", point.error);
        // A planted fault: one seed is another.
        assert!(!close(reckoned(&materials, study, &point, 1)), "{family:?} {scenes}");
    }
}

#[test]
fn the_reference_is_the_loss_over_other_scenes_within_their_error() {
    let materials = materials();
    let study = studied();
    let same = point(study, Family::Sobol, 6144);
    let other = plain_loss(&materials, &same.choice, 12_345);
    let off = (other / study.reference.loss - 1.0) / same.error;
    assert!(off.abs() < STUDY_REFERENCE, "{off} times the error of a loss over such scenes");
    assert!(study.reference.error < 1e-3, "{:?}", study.reference);
    let random = [9, 90, 900, 9000].map(|scenes| point(study, Family::Random, scenes).error);
    assert!(random.is_sorted_by(|a, b| a > b), "{random:?}");
}

#[test]
fn maps_are_quantized_as_files_hold_them() {
    let folder = tempfile::tempdir().unwrap();
    let [material, prediction] = materials();
    let cases = [
        ("8.png", Depth::Eight, FileKind::Packed { sixteen: false, like: Preset::Deschaintre }),
        ("16.png", Depth::Sixteen, FileKind::Packed { sixteen: true, like: Preset::Deschaintre }),
        ("half.exr", Depth::Half, FileKind::Exr { half: true, preview: false }),
        ("float.exr", Depth::Float, FileKind::Exr { half: false, preview: false }),
    ];
    for (name, depth, kind) in cases {
        let through_file = |material: &Material<f32>| {
            let path = folder.path().join(name);
            write::write(material, &path, kind).unwrap();
            let read = read::read::<f32>(&path, &LINEAR, &Progress::default()).unwrap();
            read.material.renamed(material.name())
        };
        let (expected, got) = (through_file(&material), material.after_round_trip(depth).unwrap());
        assert!(got == expected, "{name}");
        assert_eq!(got == material, depth == Depth::Float, "{name}");
        if depth == Depth::Eight {
            let study = studied();
            let point = point(study, Family::EightBitMaps, 96);
            let pairs = [[expected, through_file(&prediction)], [material.clone(), prediction.clone()]];
            let [stored, exact] = pairs.map(|pair| {
                let of_seed = |seed| plain_loss(&pair, &point.choice, seed);
                (0..point.runs as u64).map(of_seed).sum::<f64>() / point.runs as f64
            });
            let shift = (stored - exact) / study.reference.loss;
            assert!((point.shift - shift).abs() < STUDY_SHIFT, "{} is not {shift}", point.shift);
            assert!(shift.abs() > 10.0 * STUDY_SHIFT, "{shift} tells nothing");
        }
    }
}

#[test]
fn a_study_is_the_same_every_time_but_for_the_times_and_can_be_cancelled_at_any_point() {
    let [ground_truth, prediction] = &materials();
    let pair = Pair { ground_truth, prediction, convention: PRINTED };
    let progress = Progress::default();
    let mut second = None;
    let cancelled = study::run(&pair, &progress, |study| {
        if study.points.len() == 9 {
            second = Some(study.clone());
            progress.cancel();
        }
    });
    assert!(matches!(&cancelled, Err(error) if error.is_cancelled()), "{cancelled:?}");
    let (first, second) = (studied(), second.unwrap());
    let untimed = |study: &Study| Reference { seconds: 0.0, ..study.reference };
    assert_eq!(untimed(first), untimed(&second));
    // The time decides how often other precisions and maps are run, and which choices are left out: on a busy machine, many are.
    let twin = |p: &Point| first.points.iter().find(|q| (q.choice, q.runs) == (p.choice, p.runs));
    let pairs: Vec<_> = second.points.iter().filter_map(|p| Some((p, twin(p)?))).collect();
    assert!(pairs.len() >= 2, "{}", pairs.len());
    for (p, q) in pairs {
        assert_eq!((p.error, p.shift, p.seeds), (q.error, q.shift, q.seeds));
    }
}

#[test]
fn there_is_no_error_to_study_where_there_is_no_loss() {
    let [ground_truth, _] = materials();
    let twin = ground_truth.clone().renamed("twin");
    let refused = run(&[ground_truth, twin], &Progress::default());
    assert!(matches!(&refused, Err(Error::NothingToStudy)), "{refused:?}");
}
