//! Whose renderer gave out radiances.

use pyo3::prelude::*;
use svbrdf_evaluate::conform::{self as identification, RenderedPoints};
use svbrdf_evaluate::report::ConformReport;
use svbrdf_files::arrays::{Array, Arrays};
use svbrdf_files::convention;

use crate::errors::{Error, exception};
use crate::report::Views;

/// Arrays: name, shape and values.
type Named = Vec<(String, Vec<usize>, Vec<f64>)>;

/// The probe points.
#[pyfunction]
pub fn probes() -> PyResult<Named> {
    let arrays = identification::probes().map_err(Error::new_err)?;
    Ok(arrays.into_iter().map(|(name, array)| (name, array.shape, array.values)).collect())
}

/// The verdict on points with `radiance`, compared with a convention.
#[pyfunction]
pub fn conform(py: Python<'_>, arrays: Named, convention: &str, metallic: Option<bool>) -> PyResult<Views> {
    let asked = convention::read(convention).map_err(exception)?;
    let array = |(name, shape, values): (String, Vec<usize>, Vec<f64>)| (name, Array::new(&shape, values));
    let arrays: Arrays = arrays.into_iter().map(array).collect();
    let answer = RenderedPoints::new(&arrays, metallic).map_err(Error::new_err)?;
    Views::new(&py.detach(|| ConformReport::new(&answer, &asked)))
}
