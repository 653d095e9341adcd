//! Many materials: the losses of methods over a data set.

use std::collections::BTreeMap;
use std::path::PathBuf;

use pyo3::prelude::*;
use svbrdf_evaluate::KeptAnswer;
use svbrdf_evaluate::dataset::{self, DatasetReading, DatasetReport, DatasetSettings, Method, Pick, Source};

use svbrdf_evaluate::metrics::MetricSelection;
use svbrdf_evaluate::protocols::{MaskSource, Protocol};
use svbrdf_evaluate::registration::Registration;
use svbrdf_files::convention::ChosenConvention;

use crate::asked::{options, question};
use crate::errors::exception;
use crate::material::read_options;
use crate::report::ReportViews;
use crate::work;

/// The registrations of these names.
fn parsed(ways: BTreeMap<String, String>) -> PyResult<BTreeMap<String, Registration>> {
    let one = |(method, way): (String, String)| Ok((method, way.parse::<Registration>().map_err(exception)?));
    ways.into_iter().map(one).collect()
}

/// What is asked for.
#[derive(Debug, FromPyObject)]
#[pyo3(from_item_all)]
pub struct DatasetAsked {
    /// The folder of ground truths.
    ground_truths: PathBuf,
    /// Name and folder of each method.
    methods: Vec<(String, PathBuf)>,
    /// [`LossOptions`](svbrdf_core::loss::LossOptions) as JSON.
    question: String,
    convention: String,
    pick: String,
    strict: bool,
    /// Words of the names of metrics, none for all; `None` for none.
    metrics: Option<Vec<String>>,
    /// A name of a protocol, or a file.
    protocol: Option<String>,
    /// Ways of registration by the name of a method.
    register: BTreeMap<String, String>,
    /// `alpha`, or the path of a picture.
    mask: Option<String>,
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
) -> PyResult<ReportViews> {
    let protocol = asked.protocol.as_deref().map(Protocol::read).transpose().map_err(exception)?;
    let convention = ChosenConvention::read(&asked.convention).map_err(exception)?;
    let pick: Pick = asked.pick.parse().map_err(exception)?;
    let reading = DatasetReading {
        ground_truths: read_options(&asked.read[0])?,
        predictions: read_options(&asked.read[1])?,
        methods: asked
            .read_methods
            .iter()
            .map(|(name, options)| Ok((name.clone(), read_options(options)?)))
            .collect::<PyResult<_>>()?,
        registrations: parsed(asked.register)?,
        mask: asked.mask.as_deref().map(str::parse::<MaskSource>).transpose().map_err(exception)?,
        strict: asked.strict,
        ..DatasetReading::default()
    };
    let methods = asked.methods.into_iter().map(|(name, path)| Method { name, path }).collect();
    let source = Source::Folders { ground_truths: asked.ground_truths, methods };
    let cases = source.cases().map_err(exception)?;
    let options = options(question(&asked.question)?)?;
    let metrics = asked.metrics.map(MetricSelection::try_from).transpose().map_err(exception)?;
    let reading = protocol.iter().fold(reading, DatasetReading::over);
    let request = options.request().map_err(exception)?;
    let settings = DatasetSettings::new(source, convention, request, &cases);
    let settings = settings.following(&options, metrics, protocol).map_err(exception)?;
    let settings = DatasetSettings { common: asked.common, diagnose: asked.diagnose, ..settings };
    let folder = asked.results.as_deref();
    let (reading, KeptAnswer { answer: results, notes, unkept }, files) =
        work::run(py, progress, |progress| {
            let reading = dataset::decided(&cases, reading, progress)?;
            let found = dataset::run(&cases, &settings, &reading, folder, progress)?;
            Ok::<_, svbrdf_evaluate::Error>((reading, found, dataset::digests(&cases, progress)?))
        })?;
    let mut report = DatasetReport::new(settings, reading, results, pick);
    report.files = files;
    for warning in notes.into_iter().chain(unkept).chain(report.doubts()) {
        py.import("warnings")?.call_method1("warn", (warning,))?;
    }
    ReportViews::new(&report, true)
}
