//! The losses of all predictions of all materials.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::time::SystemTime;

use rayon::prelude::*;

use svbrdf_core::error::Error;
use svbrdf_core::loss::{Comparison, Loss, Request, check_same_size};
use svbrdf_core::material::Material;
use svbrdf_core::metrics::of_maps;
use svbrdf_core::model::convention::Convention;
use svbrdf_core::progress::Progress;
use svbrdf_core::rank::most_scenes;

use super::record::{
    Candidate, Case, DatasetReading, DatasetSettings, KnownLoss, MaterialResult, PredictionResult,
};
use crate::read::{self, ReadOptions};

/// The result of a material, and the files that it was computed from.
#[derive(Debug)]
pub(super) struct Evaluated {
    pub(super) result: MaterialResult,
    /// The path of the ground truth, then that of each prediction, with the files that were read.
    pub(super) read: Vec<(PathBuf, Vec<PathBuf>)>,
    /// When the first of them was opened, or earlier.
    pub(super) start: SystemTime,
}

/// Computes the losses of `cases`, in parallel; `done` gets each result as soon as it is there, in any order.
///
/// All predictions of a material are compared in the same scenes, as many as the target error of every one needs, at most
/// [`most_scenes`]. A material that cannot be read or compared has a result, too, with the reason. A material is one step of
/// `progress`. The results do not depend on the number of threads, nor on which other materials there are.
///
/// # Errors
/// [`Error::Cancelled`], [`Error::UnknownName`] for an unknown convention, and those of `done`.
pub(super) fn evaluate(
    cases: &[Case],
    settings: &DatasetSettings,
    reading: &DatasetReading,
    progress: &Progress,
    done: impl Fn(Evaluated) -> Result<(), Error> + Sync,
) -> Result<(), Error> {
    let convention = settings.convention.parse()?;
    progress.begin(cases.len() as u64);
    cases.par_iter().try_for_each(|case| {
        done(one(case, settings, convention, reading, progress)?)?;
        progress.step()
    })
}

fn one(
    case: &Case,
    settings: &DatasetSettings,
    convention: Convention,
    reading: &DatasetReading,
    progress: &Progress,
) -> Result<Evaluated, Error> {
    let start = SystemTime::now();
    let seed = seed_of(settings.seed, case.index);
    let (truth, files) = open(&case.ground_truth, &reading.ground_truths, reading.strict);
    let mut read = vec![(case.ground_truth.clone(), files)];
    let mut predictions: Vec<Result<Material<f32>, String>> = Vec::new();
    for candidate in &case.candidates {
        let (prediction, files) = match &truth {
            Ok(_) => open(&candidate.path, &reading.predictions, reading.strict),
            Err(problem) => (Err(format!("ground truth: {problem}")), Vec::new()),
        };
        read.push((candidate.path.clone(), files));
        predictions.push(prediction.and_then(|prediction| same_size(&truth, prediction)));
    }
    let readable: Vec<&Material<f32>> = predictions.iter().flatten().collect();
    let outcome = match &truth {
        Ok(truth) if !readable.is_empty() => {
            let request = Request::Accuracy { target: settings.target_error, seed };
            let comparison = Comparison::new(truth, &readable, convention)?;
            Some(comparison.at_most(most_scenes(readable.len())).run(&request, &progress.part())?)
        }
        _ => None,
    };
    let mut losses = outcome.iter().flat_map(|outcome| &outcome.losses);
    let result = |(candidate, prediction): (&Candidate, &Result<Material<f32>, String>)| {
        let metrics = match (&truth, prediction) {
            (Ok(truth), Ok(prediction)) if settings.metrics => metrics(truth, prediction),
            _ => BTreeMap::new(),
        };
        let loss = prediction.as_ref().map_err(Clone::clone);
        let loss = loss.and_then(|_| losses.next().map(known).ok_or_else(|| "no loss".to_owned()));
        let Candidate { method, sample, path } = candidate;
        let path = path.display().to_string();
        PredictionResult { method: method.clone(), sample: *sample, path, result: loss, metrics }
    };
    let predictions = case.candidates.iter().zip(&predictions).map(result).collect();
    let scenes = outcome.as_ref().map_or(0, |outcome| outcome.scenes.len());
    let result =
        MaterialResult { index: case.index, material: case.material.clone(), seed, scenes, predictions };
    Ok(Evaluated { result, read, start })
}

/// The material at `path`, or why it cannot be used; and the files that were read.
fn open(path: &Path, options: &ReadOptions, strict: bool) -> (Result<Material<f32>, String>, Vec<PathBuf>) {
    let read = match read::read(path, options, &Progress::default()) {
        Ok(read) => read,
        Err(problem) => return (Err(problem.to_string()), Vec::new()),
    };
    let guesses = if strict { read.refuse_guesses(path) } else { Ok(()) };
    (guesses.map(|()| read.material).map_err(|problem| problem.to_string()), read.files)
}

/// The prediction, where it has the size of the ground truth.
fn same_size(
    truth: &Result<Material<f32>, String>,
    prediction: Material<f32>,
) -> Result<Material<f32>, String> {
    let checked = truth.as_ref().map_or(Ok(()), |truth| check_same_size(truth, &prediction));
    checked.map(|()| prediction).map_err(|problem| problem.to_string())
}

/// The metrics of the maps of materials of one size.
fn metrics(truth: &Material<f32>, prediction: &Material<f32>) -> BTreeMap<String, f64> {
    let metrics = of_maps(truth, prediction).unwrap_or_default();
    metrics.into_iter().map(|metric| (metric.name.to_owned(), metric.value)).collect()
}

fn known(loss: &Loss) -> KnownLoss {
    let estimate = &loss.estimate;
    KnownLoss {
        loss: estimate.mean,
        standard_error: estimate.standard_error.unwrap_or(0.0),
        interval95: estimate.interval95.unwrap_or([estimate.mean; 2]),
    }
}

/// The seed of the scenes of a material.
fn seed_of(seed: u64, index: usize) -> u64 {
    /// Odd: the fractional part of the root of 5, times 2^64.
    const STEP: u64 = 0x3c6e_f372_fe94_f82b;
    seed.wrapping_add(STEP.wrapping_mul(index as u64))
}
