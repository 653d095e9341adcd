//! Many materials: the losses of methods over a data set.

use std::path::{Path, PathBuf};

use pyo3::prelude::*;
use svbrdf_files::dataset::{self, DatasetReport, Pick, RunSettings, Side};
use svbrdf_core::error::Error;
use svbrdf_files::read as reading;
use svbrdf_core::material::Material;
use svbrdf_core::model::convention::Convention;
use svbrdf_core::progress::Progress;

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

/// The losses of all methods over a data set.
#[pyfunction]
pub fn rank_dataset(
    py: Python<'_>,
    asked: DatasetAsked,
    progress: Option<&Bound<'_, PyAny>>,
) -> PyResult<Views> {
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
    let settings =
        RunSettings::new(convention.name, asked.target_error, asked.seed, &tasks).with_metrics(asked.metrics);
    let journal = asked.journal.as_deref();
    let results = work::run(py, progress, |progress| {
        dataset::run(&tasks, &settings, &convention, open, journal, progress)
    })?;
    Views::new(&DatasetReport::new(settings, results, pick))
}
