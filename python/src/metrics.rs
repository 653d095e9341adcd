//! Metrics beside the loss.

use pyo3::prelude::*;
use svbrdf_core::loss::Request;
use svbrdf_core::metrics::{of_maps, of_renderings};
use svbrdf_core::report::MetricsReport;

use crate::asked::{Asked, singles};
use crate::errors::exception;
use crate::material::CoreMaterial;
use crate::report::Views;
use crate::work;

/// The metrics of the maps and renderings of `predictions`.
#[pyfunction]
pub fn metrics(
    py: Python<'_>,
    ground_truth: &CoreMaterial,
    predictions: Vec<PyRef<'_, CoreMaterial>>,
    asked: Asked,
    progress: Option<&Bound<'_, PyAny>>,
) -> PyResult<Views> {
    let (convention, request) = (asked.convention()?, asked.request()?);
    let sampling = match &request {
        Request::Scenes(sampling) => Some(*sampling),
        _ => None,
    };
    let scenes = request.scenes(&convention).map_err(exception)?.unwrap_or_default();
    let all = singles(ground_truth, &predictions);
    let mut results = Vec::new();
    for (prediction, name) in all[1..].iter().zip(asked.predictions()) {
        let metrics = work::run(py, progress, |progress| {
            let of_renderings = of_renderings(&all[0], prediction, &scenes, &convention, progress)?;
            Ok([of_maps(&all[0], prediction)?, of_renderings].concat())
        })?;
        results.push((name.clone(), metrics));
    }
    let compared = asked.compared(&all[0], &convention);
    Views::new(&MetricsReport::new(&compared, sampling.as_ref(), &scenes, results))
}
