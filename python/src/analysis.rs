//! The analyses that the crate declares.

use pyo3::prelude::*;
use svbrdf_core::text::of_json;
use svbrdf_evaluate::Error as EvaluateError;
use svbrdf_evaluate::analyses::AnyAnalysis;
use svbrdf_evaluate::report::AnalysisInput;

use crate::asked::Asked;
use crate::errors::{Error, exception};
use crate::report::Views;
use crate::work;

/// The report of the analysis of this name, with its own options as JSON.
#[pyfunction]
pub fn analysis(
    py: Python<'_>,
    asked: Asked<'_>,
    name: &str,
    options: &str,
    progress: Option<&Bound<'_, PyAny>>,
) -> PyResult<Views> {
    let analysis = AnyAnalysis::named(name).ok_or_else(|| Error::new_err(format!("no analysis {name}")))?;
    let options = serde_json::from_str(options).map_err(|problem| Error::new_err(of_json(&problem)))?;
    let materials = asked.singles();
    let input = AnalysisInput {
        ground_truth: &materials[0],
        predictions: materials[1..].iter().collect(),
        convention: asked.convention()?,
        request: analysis.request(&asked.options()?).map_err(exception)?,
    };
    // A report is no value of several threads.
    work::run(py, progress, |progress| {
        Ok::<_, EvaluateError>(Views::new(&*analysis.run(&input, options, progress)?))
    })?
}
