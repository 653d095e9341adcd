//! Many materials: the losses of methods over a data set.

use std::collections::BTreeMap;
use std::path::PathBuf;

use pyo3::prelude::*;
use svbrdf::dataset::{
    self, DatasetReading, DatasetResults, DatasetSettings, MaterialResult, MethodSummary, MetricSummary, Pick,
    summarize_metrics,
};
use svbrdf::model::convention::Convention;

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
    metrics: bool,
    journal: Option<PathBuf>,
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
    /// Of the maps, by name.
    metrics: BTreeMap<String, MetricItems>,
}

/// A metric of a method over the materials.
#[derive(Debug, IntoPyObject)]
pub struct MetricItems {
    mean: f64,
    median: f64,
    interval95_materials: Option<(f64, f64)>,
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
    /// Of its maps, by name.
    metrics: BTreeMap<String, f64>,
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
    let reading = DatasetReading {
        ground_truths: read_options(&asked.read[0])?,
        predictions: read_options(&asked.read[1])?,
        strict: asked.strict,
    };
    let cases = dataset::cases_of_folders(&asked.ground_truths, &asked.methods).map_err(exception)?;
    let settings =
        DatasetSettings::new(convention.name, asked.target_error, asked.seed, &cases).with_metrics(asked.metrics);
    let journal = asked.journal.as_deref();
    let DatasetResults { results, recomputed } =
        work::run(py, progress, |progress| dataset::run(&cases, &settings, &reading, journal, progress))?;
    for recomputed in recomputed {
        py.import("warnings")?.call_method1("warn", (recomputed.to_string(),))?;
    }
    let summaries = dataset::summarize(&settings.methods, &results, pick);
    let summaries = summaries.into_iter().map(|summary| {
        let metrics = summarize_metrics(&summary.method, &results, pick);
        SummaryItems::new(summary, metrics)
    });
    Ok((summaries.collect(), results.iter().flat_map(predictions).collect()))
}

fn interval(interval: Option<[f64; 2]>) -> Option<(f64, f64)> {
    interval.map(|[low, high]| (low, high))
}

impl SummaryItems {
    fn new(summary: MethodSummary, metrics: BTreeMap<String, MetricSummary>) -> Self {
        let to_best = summary.to_best;
        Self {
            ties_with_best: summary.ties_with_best(),
            method: summary.method,
            materials: summary.materials,
            failures: summary.failures,
            mean: summary.mean,
            median: summary.median,
            interval95_materials: interval(summary.interval95_materials),
            interval95_scenes: summary.interval95_scenes.into(),
            to_best: to_best.map(|difference| difference.mean),
            to_best_interval95_materials: to_best
                .and_then(|difference| interval(difference.interval95_materials)),
            metrics: metrics.into_iter().map(|(name, metric)| (name, metric.into())).collect(),
        }
    }
}

impl From<MetricSummary> for MetricItems {
    fn from(MetricSummary { mean, median, interval95_materials }: MetricSummary) -> Self {
        Self { mean, median, interval95_materials: interval(interval95_materials) }
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
            metrics: prediction.metrics.clone(),
        }
    })
}
