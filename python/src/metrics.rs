//! The metrics of published evaluations.

use std::path::Path;

use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use svbrdf_core::loss::check_same_size;
use svbrdf_evaluate::metrics::of_matfusion;
use svbrdf_evaluate::report::MetricsReport;
use svbrdf_files::read::MaterialPath;

use crate::asked::Asked;
use crate::errors::exception;
use crate::material::{CoreMaterial, read_options};
use crate::report::Views;
use crate::work;

/// The metrics of MatFusion's evaluation. Files are read anew: it compares normals of the lengths that are stored.
/// `options` are those that each material was read with; None for one of arrays.
#[pyfunction]
pub fn matfusion(
    py: Python<'_>,
    ground_truth: &CoreMaterial,
    predictions: Vec<PyRef<'_, CoreMaterial>>,
    asked: Asked,
    options: Vec<Option<String>>,
    progress: Option<&Bound<'_, PyAny>>,
) -> PyResult<Views> {
    let materials = asked.materials(ground_truth, &predictions, CoreMaterial::double);
    let truth = &materials[0];
    for prediction in &materials[1..] {
        check_same_size(truth, prediction).map_err(exception)?;
    }
    let stored = |source: (&Option<String>, &Option<String>)| match source {
        (Some(path), Some(options)) => {
            let options = &read_options(options)?;
            work::run(py, progress, |progress| {
                let path = MaterialPath::new(Path::new(path), options);
                path.planes_as_stored::<f64>(progress).map(|(planes, _)| planes)
            })
        }
        _ => Err(PyValueError::new_err(
            "protocol: expected files, found a Material of arrays, whose normals are not as stored; give paths, or what \
            svbrdf.read returns",
        )),
    };
    let planes = asked.paths.iter().zip(&options).map(stored).collect::<PyResult<Vec<_>>>()?;
    let mut results = Vec::new();
    for (planes_of, prediction) in planes[1..].iter().zip(&materials[1..]) {
        let metrics =
            work::run(py, progress, |progress| of_matfusion(&planes[0], planes_of, truth.size(), progress))?;
        results.push((prediction.name().to_owned(), metrics));
    }
    Views::new(&MetricsReport::matfusion(truth.name(), truth.size(), results))
}
