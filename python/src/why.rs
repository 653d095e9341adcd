//! Causes of a loss: maps, scenes, texels and directions.

use pyo3::prelude::*;
use pyo3::types::PyByteArray;
use svbrdf_core::diagnose::{self as diagnosis, Diagnosis};
use svbrdf_core::loss::Comparison;
use svbrdf_core::model::scene::Endpoint;
use svbrdf_core::report::{BlameReport, DiagnoseReport, MapReport, ScenesReport, WorstReport};
use svbrdf_core::why;

use crate::arrays;
use crate::asked::{Asked, singles};
use crate::errors::{Error, exception};
use crate::material::CoreMaterial;
use crate::report::Views;
use crate::work;

/// The attributions of the losses of `predictions`.
#[pyfunction]
pub fn blame(
    py: Python<'_>,
    ground_truth: &CoreMaterial,
    predictions: Vec<PyRef<'_, CoreMaterial>>,
    asked: Asked,
    progress: Option<&Bound<'_, PyAny>>,
) -> PyResult<Views> {
    let (convention, request) = (asked.convention()?, asked.request()?);
    let all = singles(ground_truth, &predictions);
    let mut attributions = Vec::new();
    for (prediction, name) in all[1..].iter().zip(asked.predictions()) {
        let found = work::run(py, progress, |progress| {
            why::attribute(&all[0], prediction, &convention, &request, progress)
        })?;
        attributions.push(why::Attribution { prediction: name.clone(), ..found });
    }
    Views::new(&BlameReport::new(asked.compared(&all[0], &convention), &request, attributions))
}

/// The diagnosis of the loss of each of `predictions`.
#[pyfunction]
pub fn diagnose(
    py: Python<'_>,
    ground_truth: &CoreMaterial,
    predictions: Vec<PyRef<'_, CoreMaterial>>,
    asked: Asked,
    progress: Option<&Bound<'_, PyAny>>,
) -> PyResult<Views> {
    let (convention, all) = (asked.convention()?, singles(ground_truth, &predictions));
    let truth = &*all[0];
    let floor = work::run(py, progress, |progress| {
        diagnosis::floor(truth, &ground_truth.storage, &convention, asked.seed, progress)
    })?;
    let mut diagnoses = Vec::new();
    for ((prediction, name), stored) in all[1..].iter().zip(asked.predictions()).zip(&predictions) {
        let storage = &stored.storage;
        let found = work::run(py, progress, |progress| {
            diagnosis::diagnose(truth, prediction, storage, &convention, asked.seed, progress)
        })?;
        diagnoses.push(Diagnosis { prediction: name.clone(), ..found });
    }
    let compared = asked.compared(truth, &convention);
    let seams = diagnosis::seams(truth);
    Views::new(&DiagnoseReport { compared, seed: asked.seed, floor, seams, diagnoses })
}

/// The worst scene of each of `predictions`.
#[pyfunction]
pub fn worst(
    py: Python<'_>,
    ground_truth: &CoreMaterial,
    predictions: Vec<PyRef<'_, CoreMaterial>>,
    asked: Asked,
    progress: Option<&Bound<'_, PyAny>>,
) -> PyResult<Views> {
    let (convention, all) = (asked.convention()?, singles(ground_truth, &predictions));
    let mut found = Vec::new();
    for (prediction, name) in all[1..].iter().zip(asked.predictions()) {
        let worst = work::run(py, progress, |progress| {
            why::worst(&all[0], prediction, &convention, asked.seed, why::TAIL, progress)
        })?;
        found.push(why::Worst { prediction: name.clone(), ..worst });
    }
    Views::new(&WorstReport { compared: asked.compared(&all[0], &convention), tail: why::TAIL, found })
}

/// The `top` scenes with the largest losses.
#[pyfunction]
pub fn scenes(
    py: Python<'_>,
    ground_truth: &CoreMaterial,
    predictions: Vec<PyRef<'_, CoreMaterial>>,
    asked: Asked,
    top: usize,
    progress: Option<&Bound<'_, PyAny>>,
) -> PyResult<Views> {
    let (convention, request) = (asked.convention()?, asked.request()?);
    let materials = singles(ground_truth, &predictions);
    let all: Vec<_> = materials.iter().map(|material| &**material).collect();
    let comparison = Comparison::new(all[0], &all[1..], convention).map_err(exception)?.without_pilot();
    let outcome = work::run(py, progress, |progress| comparison.run(&request, progress))?;
    let compared = asked.compared(all[0], &convention);
    Views::new(&ScenesReport::new(compared, asked.named(outcome)).top(top))
}

/// The axes of a map over directions.
#[derive(Debug, FromPyObject)]
#[pyo3(from_item_all)]
pub struct DirectionsAsked {
    /// "lights" or "views".
    over: String,
    fixed: [f64; 3],
    side: usize,
}

/// A map of the loss of each prediction.
#[derive(Debug, IntoPyObject)]
pub struct MapItems<'py> {
    views: Views,
    /// Over texels: f32, height x width x 3 each. Over directions: f64, side x side each, NaN outside of the disk.
    maps: Vec<Bound<'py, PyByteArray>>,
    /// Over directions: f64, side x side each.
    standard_errors: Vec<Bound<'py, PyByteArray>>,
    /// Over directions: f64, side x side x 3, NaN outside of the disk.
    directions: Option<Bound<'py, PyByteArray>>,
}

/// The loss over texels, or over directions.
#[pyfunction]
pub fn map<'py>(
    py: Python<'py>,
    ground_truth: &CoreMaterial,
    predictions: Vec<PyRef<'_, CoreMaterial>>,
    asked: Asked,
    over: Option<DirectionsAsked>,
    progress: Option<&Bound<'_, PyAny>>,
) -> PyResult<MapItems<'py>> {
    let (convention, materials) = (asked.convention()?, singles(ground_truth, &predictions));
    let all: Vec<_> = materials.iter().map(|material| &**material).collect();
    let comparison = Comparison::new(all[0], &all[1..], convention).map_err(exception)?.without_pilot();
    let report = match over {
        None => {
            let scenes = asked.request()?.scenes(&convention).map_err(exception)?.unwrap_or_default();
            work::run(py, progress, |progress| MapReport::over_texels(&comparison, &scenes, progress))
        }
        Some(DirectionsAsked { over, fixed, side }) => {
            let moved = moved(&over)?;
            work::run(py, progress, |p| MapReport::over_directions(&comparison, moved, fixed, side, p))
        }
    }?;
    let report = report.renamed(&asked.names);
    let views = Views::without_rows(&report)?;
    let Some((_, map)) = &report.directions else {
        let pixels = report
            .images
            .iter()
            .map(|image| arrays::bytes(py, 3 * image.pixels.len(), image.pixels.iter().flatten().copied()));
        let maps = pixels.collect::<PyResult<_>>()?;
        return Ok(MapItems { views, maps, standard_errors: Vec::new(), directions: None });
    };
    let planes = |planes: &[Vec<f64>]| -> PyResult<Vec<_>> {
        planes.iter().map(|plane| arrays::bytes(py, plane.len(), plane.iter().copied())).collect()
    };
    let directions = map.directions.iter().flat_map(|direction| direction.unwrap_or([f64::NAN; 3]));
    Ok(MapItems {
        views,
        maps: planes(&map.losses)?,
        standard_errors: planes(&map.standard_errors)?,
        directions: Some(arrays::bytes(py, 3 * map.directions.len(), directions)?),
    })
}

fn moved(over: &str) -> PyResult<Endpoint> {
    match over {
        "lights" => Ok(Endpoint::Light),
        "views" => Ok(Endpoint::View),
        _ => {
            Err(Error::new_err(format!("unknown axes of a map `{over}`; use one of: texels, lights, views")))
        }
    }
}
