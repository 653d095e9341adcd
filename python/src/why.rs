//! Causes of a loss: trivial ones, texels and directions.

use pyo3::prelude::*;
use svbrdf_core::loss::{Comparison, Estimate};
use svbrdf_core::material::Material;
use svbrdf_core::model::convention::Convention;
use svbrdf_core::model::scene::Endpoint;
use svbrdf_evaluate::diagnose::{self as diagnosis, Storage};
use svbrdf_evaluate::report::{Compared, DiagnoseReport, MapReport};

use crate::arrays;
use crate::asked::Asked;
use crate::errors::{Error, exception};
use crate::report::Views;
use crate::work;

/// The diagnosis of the loss of each of `predictions`.
#[pyfunction]
pub fn diagnose(py: Python<'_>, asked: Asked<'_>, progress: Option<&Bound<'_, PyAny>>) -> PyResult<Views> {
    let (convention, seed) = (asked.convention()?, asked.seed()?);
    let materials = asked.singles();
    let storages: Vec<_> = asked.materials.iter().map(|material| &material.get().storage).collect();
    let truth = &materials[0];
    let floor = floor_of(py, (truth, storages[0]), &convention, seed, progress)?;
    let of_each = materials.iter().zip(&storages).skip(1).map(|(material, storage)| {
        let (pair, storages) = ([truth, material], [storages[0], *storage]);
        work::run(py, progress, |progress| {
            diagnosis::diagnose(pair, storages, &convention, floor.mean, seed, progress)
        })
    });
    let diagnoses = of_each.collect::<PyResult<_>>()?;
    Views::new(&DiagnoseReport::new(Compared::new(truth, &convention), seed, floor, diagnoses))
}

/// The loss that a ground truth cannot resolve.
///
/// # Errors
/// Those of the loss.
pub fn floor_of(
    py: Python<'_>,
    (truth, storage): (&Material<f32>, &Storage),
    convention: &Convention,
    seed: u64,
    progress: Option<&Bound<'_, PyAny>>,
) -> PyResult<Estimate> {
    work::run(py, progress, |progress| diagnosis::floor(truth, storage, convention, seed, progress))
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
    maps: Vec<Bound<'py, PyAny>>,
    /// Over directions: f64, side x side each, and the directions, side x side x 3, NaN outside of the disk.
    of_directions: Option<(Vec<Bound<'py, PyAny>>, Bound<'py, PyAny>)>,
}

/// The loss over texels, or over directions.
#[pyfunction]
pub fn map<'py>(
    py: Python<'py>,
    asked: Asked<'_>,
    over: Option<DirectionsAsked>,
    progress: Option<&Bound<'_, PyAny>>,
) -> PyResult<MapItems<'py>> {
    let (convention, materials) = (asked.convention()?, asked.singles());
    let all: Vec<_> = materials.iter().collect();
    let comparison = Comparison::new(all[0], &all[1..], convention).map_err(exception)?.without_pilot();
    let report = match over {
        None => {
            let scenes = asked.listed()?.scenes(&convention).map_err(exception)?.unwrap_or_default();
            work::run(py, progress, |progress| MapReport::over_texels(&comparison, &scenes, progress))
        }
        Some(DirectionsAsked { over, fixed, side }) => {
            let moved = moved(&over)?;
            if !(1..=1024).contains(&side) {
                return Err(Error::new_err(format!("side: expected 1 to 1024, found {side}")));
            }
            work::run(py, progress, |p| MapReport::over_directions(&comparison, moved, fixed, side, p))
        }
    }?;
    let views = Views::without_rows(&report)?;
    let Some((_, map)) = &report.directions else {
        let pixels = report.images.iter().map(|image| {
            arrays::array(py, image.pixels.iter().flatten().copied(), [image.width, image.height], 3)
        });
        return Ok(MapItems { views, maps: pixels.collect::<PyResult<_>>()?, of_directions: None });
    };
    let size = [map.side; 2];
    let planes = |planes: &[Vec<f64>]| -> PyResult<Vec<_>> {
        planes.iter().map(|plane| arrays::array(py, plane.iter().copied(), size, 1)).collect()
    };
    let directions = map.directions.iter().flat_map(|direction| direction.unwrap_or([f64::NAN; 3]));
    let directions = arrays::array(py, directions, size, 3)?;
    let of_directions = Some((planes(&map.standard_errors)?, directions));
    Ok(MapItems { views, maps: planes(&map.losses)?, of_directions })
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
