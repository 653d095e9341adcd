//! Many materials: the losses of methods over a data set.

use std::collections::BTreeMap;
use std::path::PathBuf;

use pyo3::prelude::*;
use svbrdf_evaluate::dataset::{
    self, DatasetReading, DatasetReport, DatasetResults, DatasetSettings, FixedScenes, Method, Pick, Source,
};

use svbrdf_core::loss::LossOptions;
use svbrdf_evaluate::metrics::MetricSelection;
use svbrdf_evaluate::protocols::Protocol;
use svbrdf_files::convention::ChosenConvention;

use crate::asked::{options, question};
use crate::errors::exception;
use crate::material::read_options;
use crate::report::Views;
use crate::work;

/// What is asked for.
#[derive(Debug, FromPyObject)]
#[pyo3(from_item_all)]
pub struct DatasetAsked {
    /// The folder of ground truths.
    ground_truths: PathBuf,
    /// Name and folder of each method.
    methods: Vec<(String, PathBuf)>,
    /// [`LossOptions`] as JSON.
    question: String,
    /// The options of the command line for the same scenes.
    scenes: Vec<String>,
    convention: String,
    pick: String,
    strict: bool,
    /// Words of the names of metrics, none for all; `None` for none.
    metrics: Option<Vec<String>>,
    /// A name of a protocol, or a file.
    protocol: Option<String>,
    common: bool,
    diagnose: bool,
    results: Option<PathBuf>,
    /// Read options of the ground truths, then of the predictions, as JSON.
    read: [String; 2],
    /// Read options of methods by name, as JSON.
    read_methods: BTreeMap<String, String>,
}

/// The losses of all methods over a data set.
#[pyfunction]
pub fn rank_dataset(
    py: Python<'_>,
    asked: DatasetAsked,
    progress: Option<&Bound<'_, PyAny>>,
) -> PyResult<Views> {
    let protocol = asked.protocol.as_deref().map(Protocol::read).transpose().map_err(exception)?;
    let mut convention = ChosenConvention::read(&asked.convention).map_err(exception)?;
    let pick: Pick = asked.pick.parse().map_err(exception)?;
    let reading = DatasetReading {
        ground_truths: read_options(&asked.read[0])?,
        predictions: read_options(&asked.read[1])?,
        methods: asked
            .read_methods
            .iter()
            .map(|(name, options)| Ok((name.clone(), read_options(options)?)))
            .collect::<PyResult<_>>()?,
        strict: asked.strict,
        ..DatasetReading::default()
    };
    let methods = asked.methods.into_iter().map(|(name, path)| Method { name, path }).collect();
    let source = Source::Folders { ground_truths: asked.ground_truths, methods };
    let cases = source.cases().map_err(exception)?;
    let mut options = options(question(&asked.question)?)?;
    let metrics = asked.metrics.map(MetricSelection::try_from).transpose().map_err(exception)?;
    let metrics =
        metrics.or(protocol.as_ref().filter(|one| !one.metrics.is_empty()).map(Protocol::selection));
    if let Some(protocol) = &protocol {
        if protocol.convention.is_some() {
            convention = protocol.chosen_convention().map_err(exception)?;
        }
        if protocol.scenes.is_some() {
            options = LossOptions { seed: options.seed, ..protocol.options().map_err(exception)? };
        }
    }
    let reading = protocol.iter().fold(reading, DatasetReading::over);
    let request = options.question().map_err(exception)?.request;
    let scenes = FixedScenes::new(request, asked.scenes).map_err(exception)?;
    let (target_error, seed) = options.accuracy();
    let settings = DatasetSettings {
        metrics,
        protocol,
        common: asked.common,
        diagnose: asked.diagnose,
        ..DatasetSettings::new(source, convention, target_error, seed, &cases).in_scenes(scenes)
    };
    let folder = asked.results.as_deref();
    let (reading, DatasetResults { results, notes, unkept }, files) = work::run(py, progress, |progress| {
        let reading = dataset::decided(&cases, reading, progress)?;
        let found = dataset::run(&cases, &settings, &reading, folder, progress)?;
        Ok::<_, svbrdf_evaluate::Error>((reading, found, dataset::digests(&cases, progress)?))
    })?;
    let mut report = DatasetReport::new(settings, reading, results, pick);
    report.files = files;
    for warning in notes.into_iter().chain(unkept).chain(report.doubts()) {
        py.import("warnings")?.call_method1("warn", (warning,))?;
    }
    Views::new(&report)
}
