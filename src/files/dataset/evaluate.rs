//! The losses of all predictions of all materials.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::time::SystemTime;

use rayon::prelude::*;

use svbrdf_core::diagnose::{Storage, diagnose, floor};
use svbrdf_core::error::Error;
use svbrdf_core::loss::{Comparison, Request, check_same_size};
use svbrdf_core::material::Material;
use svbrdf_core::metrics::of_maps;
use svbrdf_core::model::convention::Convention;
use svbrdf_core::progress::Progress;
use svbrdf_core::rank::most_scenes;

use super::record::{
    Candidate, Case, DatasetReading, DatasetSettings, KnownLoss, Mark, MaterialResult, PredictionResult,
};
use super::remark::Remark;
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
/// Each prediction has as many of the scenes of its material as its target error needs, at most [`most_scenes`]: the scenes are the
/// first ones of one sequence, and no loss depends on which other predictions there are. A material that cannot be read or compared has a
/// result, too, with the reason. A material is one step of `progress`. The results do not depend on the number of threads, nor on which
/// other materials there are.
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
    let run = Run { settings, convention: settings.convention.parse()?, reading, progress };
    let seeds = settings.seeds();
    progress.begin(cases.len() as u64);
    cases.par_iter().try_for_each(|case| {
        done(run.material(case, seeds.get(case.index).copied().unwrap_or(settings.seed))?)?;
        progress.step()
    })
}

/// What the results of all materials depend on.
struct Run<'a> {
    settings: &'a DatasetSettings,
    convention: Convention,
    reading: &'a DatasetReading,
    progress: &'a Progress,
}

impl Run<'_> {
    fn material(&self, case: &Case, seed: u64) -> Result<Evaluated, Error> {
        let start = SystemTime::now();
        let truth = open(&case.ground_truth, &self.reading.ground_truths, self.reading.strict);
        let mut read = vec![(case.ground_truth.clone(), truth.files.clone())];
        let floor = self.floor(&truth, seed)?;
        let mut predictions = Vec::new();
        for candidate in &case.candidates {
            let opened = self.open(candidate, &truth);
            read.push((candidate.path.clone(), opened.files.clone()));
            predictions.push(self.prediction(candidate, &truth, opened, floor.unwrap_or(0.0), seed)?);
        }
        let (index, material) = (case.index, case.material.clone());
        let result = MaterialResult { index, material, seed, reading: truth.remarks, floor, predictions };
        Ok(Evaluated { result, read, start })
    }

    /// A prediction of the size of the ground truth, or why there is none.
    fn open(&self, candidate: &Candidate, truth: &Opened) -> Opened {
        let none = |problem| Opened { found: Err(problem), remarks: Vec::new(), files: Vec::new() };
        let truth = match (&truth.found, &candidate.missing) {
            (Err(problem), _) => return none(format!("ground truth: {problem}")),
            (_, Some(problem)) => return none(problem.clone()),
            (Ok(truth), None) => truth,
        };
        let opened = open(&candidate.path, self.reading.of_method(&candidate.method), self.reading.strict);
        let found = opened.found.and_then(|found| {
            check_same_size(&truth.material, &found.material).map_err(|problem| problem.to_string())?;
            Ok(found)
        });
        Opened { found, ..opened }
    }

    /// The result of a prediction; `floor` is that of the ground truth.
    fn prediction(
        &self,
        candidate: &Candidate,
        truth: &Opened,
        opened: Opened,
        floor: f64,
        seed: u64,
    ) -> Result<PredictionResult, Error> {
        let pair = truth.found.as_ref().ok().zip(opened.found.as_ref().ok());
        let metrics = pair.filter(|_| self.settings.metrics).map(metrics).unwrap_or_default();
        let marks = pair.filter(|_| self.settings.diagnose);
        let marks = marks.map(|pair| self.marks(pair, floor, seed)).transpose()?;
        let loss = pair.map(|pair| self.loss(pair, seed)).transpose()?;
        let result = match (loss, opened.found) {
            (Some(loss), _) => Ok(loss),
            (None, Err(problem)) => Err(problem),
            (None, Ok(_)) => Err("no loss".to_owned()),
        };
        let Candidate { method, sample, path, .. } = candidate;
        let (method, path) = (method.clone(), path.display().to_string());
        Ok(PredictionResult {
            method,
            sample: *sample,
            path,
            result,
            reading: opened.remarks,
            metrics,
            marks,
        })
    }

    fn loss(&self, (truth, prediction): Pair<'_>, seed: u64) -> Result<KnownLoss, Error> {
        let comparison = Comparison::new(&truth.material, &[&prediction.material], self.convention)?;
        let request = Request::Accuracy { target: self.settings.target_error, seed };
        let outcome = comparison.at_most(most_scenes(1)).run(&request, &self.progress.part())?;
        let estimate = outcome.losses.first().map(|loss| loss.estimate);
        let estimate = estimate.ok_or_else(|| Error::Internal("a comparison without a loss".to_owned()))?;
        Ok(KnownLoss {
            loss: estimate.mean,
            standard_error: estimate.standard_error.unwrap_or(0.0),
            interval95: estimate.interval95.unwrap_or([estimate.mean; 2]),
            scenes: outcome.scenes.len(),
        })
    }

    /// The floor of a ground truth that was read, where diagnoses are asked for.
    fn floor(&self, truth: &Opened, seed: u64) -> Result<Option<f64>, Error> {
        let truth = truth.found.as_ref().ok().filter(|_| self.settings.diagnose);
        let of = |truth: &OpenedMaterial| {
            floor(&truth.material, &truth.storage, &self.convention, seed, &self.progress.part())
        };
        Ok(truth.map(of).transpose()?.map(|floor| floor.mean))
    }

    /// The marks of the diagnosis of a prediction; none where its loss is below `floor`.
    fn marks(&self, (truth, prediction): Pair<'_>, floor: f64, seed: u64) -> Result<Vec<Mark>, Error> {
        let pair = [&truth.material, &prediction.material];
        let storages = [&truth.storage, &prediction.storage];
        let found = diagnose(pair, storages, &self.convention, floor, seed, &self.progress.part())?;
        Ok(found.marked().map(Mark::from).collect())
    }
}

/// A ground truth and a prediction of one size.
type Pair<'a> = (&'a OpenedMaterial, &'a OpenedMaterial);

/// A material that was opened, or why it cannot be used.
struct Opened {
    found: Result<OpenedMaterial, String>,
    remarks: Vec<Remark>,
    /// The files that were read.
    files: Vec<PathBuf>,
}

/// A material that was read, and how it is stored.
struct OpenedMaterial {
    material: Material<f32>,
    storage: Storage,
}

fn open(path: &Path, options: &ReadOptions, strict: bool) -> Opened {
    let read: Read<f32> = match read::read(path, options, &Progress::default()) {
        Ok(read) => read,
        Err(problem) => {
            return Opened { found: Err(problem.to_string()), remarks: Vec::new(), files: Vec::new() };
        }
    };
    let guesses = if strict { read.refuse_guesses(path) } else { Ok(()) };
    let (remarks, storage) = (Remark::of(&read), read.storage());
    let found = guesses.map(|()| OpenedMaterial { material: read.material, storage });
    Opened { found: found.map_err(|problem| problem.to_string()), remarks, files: read.files }
}

/// The metrics of the maps.
fn metrics((truth, prediction): Pair<'_>) -> BTreeMap<String, f64> {
    let metrics = of_maps(&truth.material, &prediction.material).unwrap_or_default();
    metrics.into_iter().map(|metric| (metric.name.to_owned(), metric.value)).collect()
}
