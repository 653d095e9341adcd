//! The study: its errors, against an independent reckoning.

use svbrdf_core::loss::{Comparison, Plain, Request, Sampling};
use svbrdf_core::material::Material;
use svbrdf_core::model::convention::PRINTED;
use svbrdf_core::progress::Progress;
use svbrdf_evaluate::Error;
use svbrdf_evaluate::study::{self, Family, Study, StudyPoint};
use svbrdf_files::samples;

use crate::support::tolerance::{STUDY_ERROR, STUDY_REFERENCE};

fn run([ground_truth, prediction]: &[Material<f32>; 2], progress: &Progress) -> Result<Study, Error> {
    study::run(&Comparison::new(ground_truth, &[prediction], PRINTED)?, progress)
}

/// The loss over the scenes of a point for a seed, by the plain f64 kernel.
fn plain_loss([ground_truth, prediction]: &[Material<f32>; 2], point: &StudyPoint, seed: u64) -> f64 {
    let [ground_truth, prediction]: [Material<f64>; 2] = [ground_truth.cast(), prediction.cast()];
    let comparison = Comparison::new(&ground_truth, &[&prediction], PRINTED).unwrap().on(&Plain);
    let request = Request::Scenes(Sampling { seed, ..point.sampling });
    comparison.run(&request, &Progress::default()).unwrap().losses[0].estimate.mean
}

#[test]
fn errors_are_those_of_plain_losses_over_the_same_seeds_against_that_of_many_scenes() {
    let samples = samples::load::<f32>().unwrap();
    let [prediction, _] = samples.predictions.try_into().unwrap();
    let materials = [samples.ground_truth, prediction].map(|read| read.material.resized([12, 12]).unwrap());
    let study = run(&materials, &Progress::default()).unwrap();
    let point = |family: Family, scenes: usize| {
        *study.points.iter().find(|p| p.family == family && p.scenes() == scenes).unwrap()
    };
    // The error as its definition has it.
    let reckoned = |losses: &[f64]| {
        let squares = losses.iter().map(|loss| (loss / study.reference.loss - 1.0).powi(2)).sum::<f64>();
        (squares / losses.len() as f64).sqrt()
    };
    for (family, scenes) in
        [(Family::Random, 9), (Family::Random, 90), (Family::Sobol, 24), (Family::FewTexels, 96)]
    {
        let point = point(family, scenes);
        let close = |want: f64| (point.error / want - 1.0).abs() < STUDY_ERROR;
        let losses: Vec<f64> =
            (0..=point.seeds as u64).map(|seed| plain_loss(&materials, &point, seed)).collect();
        let expected = reckoned(&losses[..point.seeds]);
        assert!(close(expected), "{family:?} {scenes}: {} is not {expected}", point.error);
        // A planted fault: one seed is another.
        assert!(!close(reckoned(&losses[1..])), "{family:?} {scenes}");
    }
    let same = point(Family::Sobol, 6144);
    let off = (plain_loss(&materials, &same, 12_345) / study.reference.loss - 1.0) / same.error;
    assert!(off.abs() < STUDY_REFERENCE, "{off} times the error of a loss over such scenes");
    assert!(study.reference.error < 1e-3, "{:?}", study.reference);
    let random = [9, 90, 900, 9000].map(|scenes| point(Family::Random, scenes).error);
    assert!(random.is_sorted_by(|a, b| a > b), "{random:?}");

    let [ground_truth, _] = materials;
    let twins = [ground_truth.clone(), ground_truth.renamed("twin")];
    let refused = run(&twins, &Progress::default());
    assert!(matches!(&refused, Err(Error::NothingToStudy)), "{refused:?}");
    let progress = Progress::default();
    progress.cancel();
    assert!(run(&twins, &progress).is_err_and(|error| error.is_cancelled()));
}
