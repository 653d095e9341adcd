//! The rendering loss, and rankings by it.

use std::str::FromStr;

use pyo3::prelude::*;
use svbrdf_core::loss::{Comparison, Compute, Precision};
use svbrdf_core::material::Material;
use svbrdf_evaluate::rank::most_scenes;
use svbrdf_evaluate::report::{Compared, LossReport, RankReport};

use crate::asked::Asked;
use crate::errors::exception;
use crate::material::CoreMaterial;
use crate::report::Views;
use crate::why::floor_of;
use crate::work;

/// The losses of `predictions` against `ground_truth`.
#[pyfunction]
pub fn loss(py: Python<'_>, asked: Asked<'_>, progress: Option<&Bound<'_, PyAny>>) -> PyResult<Views> {
    let report = match Precision::from_str(&asked.precision).map_err(exception)? {
        Precision::F32 => answer(py, &asked, &asked.singles(), progress),
        Precision::F64 => {
            let materials = asked.materials(CoreMaterial::double);
            answer(py, &asked, &materials, progress)
        }
    }?;
    Views::new(&report.read_from(asked.paths))
}

/// The answer for the first of `materials` as the ground truth and the others as predictions.
fn answer<T: Compute>(
    py: Python<'_>,
    asked: &Asked<'_>,
    materials: &[Material<T>],
    progress: Option<&Bound<'_, PyAny>>,
) -> PyResult<LossReport> {
    let question = asked.options()?.question().map_err(exception)?;
    let predictions: Vec<_> = materials[1..].iter().collect();
    let comparison = Comparison::new(&materials[0], &predictions, asked.convention()?).map_err(exception)?;
    work::run(py, progress, |progress| LossReport::answer(&comparison, &question, progress))
}

/// The ranking of `predictions` against `ground_truth`.
#[pyfunction]
pub fn rank(py: Python<'_>, asked: Asked<'_>, progress: Option<&Bound<'_, PyAny>>) -> PyResult<Views> {
    let (convention, materials) = (asked.convention()?, asked.singles());
    let all: Vec<_> = materials.iter().collect();
    let comparison = Comparison::new(all[0], &all[1..], convention).map_err(exception)?;
    let comparison = comparison.at_most(most_scenes(all.len() - 1));
    let request = asked.request()?;
    let outcome = work::run(py, progress, |progress| comparison.run(&request, progress))?;
    let mut report = RankReport::new(Compared::new(all[0], &convention), &request, &outcome);
    let storage = &asked.materials[0].get().storage;
    if storage.has_steps() {
        let floor = floor_of(py, (all[0], storage), &convention, asked.seed()?, progress)?;
        report = report.with_floor(&floor);
    }
    Views::new(&report)
}
