//! The losses of all predictions of all materials.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::time::SystemTime;

use rayon::prelude::*;

use svbrdf_core::diagnose::{Storage, diagnose, floor};
use svbrdf_core::error::Error;
use svbrdf_core::loss::{Comparison, Loss, Request, check_same_size};
use svbrdf_core::material::Material;
use svbrdf_core::metrics::of_maps;
use svbrdf_core::model::convention::Convention;
use svbrdf_core::progress::Progress;
use svbrdf_core::rank::most_scenes;

use super::record::{
    Candidate, Case, DatasetReading, DatasetSettings, KnownLoss, Mark, MaterialResult, PredictionResult,
};
use crate::read::{self, Read, ReadOptions};

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
    let mut predictions: Vec<Result<OpenedMaterial, String>> = Vec::new();
    for candidate in &case.candidates {
        let (prediction, files) = match &truth {
            Ok(_) => open(&candidate.path, &reading.predictions, reading.strict),
            Err(problem) => (Err(format!("ground truth: {problem}")), Vec::new()),
        };
        read.push((candidate.path.clone(), files));
        predictions.push(prediction.and_then(|prediction| same_size(&truth, prediction)));
    }
    let readable: Vec<&Material<f32>> = predictions.iter().flatten().map(|one| &one.material).collect();
    let outcome = match &truth {
        Ok(truth) if !readable.is_empty() => {
            let request = Request::Accuracy { target: settings.target_error, seed };
            let comparison = Comparison::new(&truth.material, &readable, convention)?;
            Some(comparison.at_most(most_scenes(readable.len())).run(&request, &progress.part())?)
        }
        _ => None,
    };
    let floor = floor_of(&truth, settings, &convention, seed, progress)?;
    let mut losses = outcome.iter().flat_map(|outcome| &outcome.losses);
    let result = |(candidate, prediction): (&Candidate, &Result<OpenedMaterial, String>)| {
        let pair = truth.as_ref().ok().zip(prediction.as_ref().ok());
        let metrics = pair.filter(|_| settings.metrics).map(metrics).unwrap_or_default();
        let marks = pair.filter(|_| settings.diagnose);
        let marks = marks.map(|pair| marks_of(pair, &convention, seed, progress)).transpose()?;
        let loss = prediction.as_ref().map_err(Clone::clone);
        let loss = loss.and_then(|_| losses.next().map(known).ok_or_else(|| "no loss".to_owned()));
        let Candidate { method, sample, path } = candidate;
        let path = path.display().to_string();
        Ok(PredictionResult { method: method.clone(), sample: *sample, path, result: loss, metrics, marks })
    };
    let predictions =
        case.candidates.iter().zip(&predictions).map(result).collect::<Result<Vec<_>, Error>>()?;
    let scenes = outcome.as_ref().map_or(0, |outcome| outcome.scenes.len());
    let (index, material) = (case.index, case.material.clone());
    let result = MaterialResult { index, material, seed, scenes, floor, predictions };
    Ok(Evaluated { result, read, start })
}

/// A material that was read, and how it is stored.
struct OpenedMaterial {
    material: Material<f32>,
    storage: Storage,
}

/// The material at `path`, or why it cannot be used; and the files that were read.
fn open(path: &Path, options: &ReadOptions, strict: bool) -> (Result<OpenedMaterial, String>, Vec<PathBuf>) {
    let read: Read<f32> = match read::read(path, options, &Progress::default()) {
        Ok(read) => read,
        Err(problem) => return (Err(problem.to_string()), Vec::new()),
    };
    let guesses = if strict { read.refuse_guesses(path) } else { Ok(()) };
    let storage = read.storage();
    let opened = guesses.map(|()| OpenedMaterial { material: read.material, storage });
    (opened.map_err(|problem| problem.to_string()), read.files)
}

/// The prediction, where it has the size of the ground truth.
fn same_size(
    truth: &Result<OpenedMaterial, String>,
    prediction: OpenedMaterial,
) -> Result<OpenedMaterial, String> {
    let checked =
        truth.as_ref().map_or(Ok(()), |truth| check_same_size(&truth.material, &prediction.material));
    checked.map(|()| prediction).map_err(|problem| problem.to_string())
}

/// The metrics of the maps of materials of one size.
fn metrics((truth, prediction): (&OpenedMaterial, &OpenedMaterial)) -> BTreeMap<String, f64> {
    let metrics = of_maps(&truth.material, &prediction.material).unwrap_or_default();
    metrics.into_iter().map(|metric| (metric.name.to_owned(), metric.value)).collect()
}

/// The floor of a ground truth that was read, where diagnoses are asked for.
fn floor_of(
    truth: &Result<OpenedMaterial, String>,
    settings: &DatasetSettings,
    convention: &Convention,
    seed: u64,
    progress: &Progress,
) -> Result<Option<f64>, Error> {
    let truth = truth.as_ref().ok().filter(|_| settings.diagnose);
    let of =
        |truth: &OpenedMaterial| floor(&truth.material, &truth.storage, convention, seed, &progress.part());
    Ok(truth.map(of).transpose()?.map(|floor| floor.mean))
}

/// The marks of the diagnosis of a prediction.
fn marks_of(
    (truth, prediction): (&OpenedMaterial, &OpenedMaterial),
    convention: &Convention,
    seed: u64,
    progress: &Progress,
) -> Result<Vec<Mark>, Error> {
    let OpenedMaterial { material, storage } = prediction;
    let found = diagnose(&truth.material, material, storage, convention, seed, &progress.part())?;
    Ok(found.marked().map(Mark::from).collect())
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
