//! Many materials: the losses of methods over a data set.

use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

use pyo3::prelude::*;
use svbrdf::dataset::{self, MaterialResult, MethodSummary, Pick, RunSettings, Side};
use svbrdf::error::Error;
use svbrdf::files::read as reading;
use svbrdf::material::Material;
use svbrdf::model::convention::Convention;
use svbrdf::progress::Progress;

use crate::errors::exception;
use crate::material::read_options;
use crate::work;

/// What is asked for.
#[derive(Debug, FromPyObject)]
#[pyo3(from_item_all)]
pub struct DatasetAsked {
    /// The folder of ground truths.
    ground_truths: PathBuf,
    /// Name and folder of each method.
    methods: Vec<(String, PathBuf)>,
    target_error: f64,
    seed: u64,
    convention: String,
    pick: String,
    strict: bool,
    /// Read options of the ground truths, then of the predictions, as JSON.
    read: [String; 2],
}

/// A method over the materials that it has a loss of.
#[derive(Debug, IntoPyObject)]
pub struct SummaryItems {
    method: String,
    materials: usize,
    failures: usize,
    mean: f64,
    median: f64,
    interval95_materials: Option<(f64, f64)>,
    interval95_scenes: (f64, f64),
    /// The mean of this method - the mean of the best, and its interval over materials.
    to_best: Option<f64>,
    to_best_interval95_materials: Option<(f64, f64)>,
    ties_with_best: bool,
}

/// One prediction of one material.
#[derive(Debug, IntoPyObject)]
pub struct PredictionItems {
    material: String,
    method: String,
    sample: usize,
    path: String,
    seed: u64,
    scenes: usize,
    loss: Option<f64>,
    standard_error: Option<f64>,
    interval95: Option<(f64, f64)>,
    /// What is wrong where there is no loss.
    error: Option<String>,
}

/// The losses of all methods over a data set: the methods, best first, and all predictions.
#[pyfunction]
pub fn rank_dataset(
    py: Python<'_>,
    asked: DatasetAsked,
    progress: Option<&Bound<'_, PyAny>>,
) -> PyResult<(Vec<SummaryItems>, Vec<PredictionItems>)> {
    let convention: Convention = asked.convention.parse().map_err(exception)?;
    let pick: Pick = asked.pick.parse().map_err(exception)?;
    let options = [read_options(&asked.read[0])?, read_options(&asked.read[1])?];
    let open = |path: &Path, side: Side| -> Result<Material<f32>, Error> {
        let options = &options[usize::from(side == Side::Prediction)];
        let read = reading::read(path, options, &Progress::default())?;
        if asked.strict {
            read.refuse_guesses(path)?;
        }
        Ok(read.material)
    };
    let tasks = dataset::tasks_of_folders(&asked.ground_truths, &asked.methods).map_err(exception)?;
    let settings = RunSettings::new(convention.name, asked.target_error, asked.seed, &tasks);
    let results = Mutex::new(Vec::new());
    let done = |result: &MaterialResult| {
        results.lock().unwrap_or_else(PoisonError::into_inner).push(result.clone());
        Ok(())
    };
    work::run(py, progress, |progress| {
        dataset::evaluate(&tasks, &settings, &convention, open, progress, done)
    })?;
    let mut results = results.into_inner().unwrap_or_else(PoisonError::into_inner);
    results.sort_by_key(|result| result.index);
    let summaries = dataset::summarize(&settings.methods, &results, pick);
    let predictions = results.iter().flat_map(predictions).collect();
    Ok((summaries.into_iter().map(SummaryItems::from).collect(), predictions))
}

impl From<MethodSummary> for SummaryItems {
    fn from(summary: MethodSummary) -> Self {
        let interval = |interval: Option<[f64; 2]>| interval.map(|[low, high]| (low, high));
        Self {
            ties_with_best: summary.ties_with_best(),
            method: summary.method,
            materials: summary.materials,
            failures: summary.failures,
            mean: summary.mean,
            median: summary.median,
            interval95_materials: interval(summary.interval95_materials),
            interval95_scenes: summary.interval95_scenes.into(),
            to_best: summary.to_best.map(|difference| difference.mean),
            to_best_interval95_materials: summary
                .to_best
                .and_then(|difference| interval(difference.interval95_materials)),
        }
    }
}

fn predictions(result: &MaterialResult) -> impl Iterator<Item = PredictionItems> {
    result.predictions.iter().map(|prediction| {
        let known = prediction.result.as_ref().ok();
        PredictionItems {
            material: result.material.clone(),
            method: prediction.method.clone(),
            sample: prediction.sample,
            path: prediction.path.clone(),
            seed: result.seed,
            scenes: result.scenes,
            loss: known.map(|known| known.loss),
            standard_error: known.map(|known| known.standard_error),
            interval95: known.map(|known| known.interval95.into()),
            error: prediction.result.as_ref().err().cloned(),
        }
    })
}
