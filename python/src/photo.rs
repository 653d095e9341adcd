//! Materials against a photograph.

use std::path::PathBuf;

use pyo3::prelude::*;
use pyo3::types::PyByteArray;
use svbrdf_core::error::Error as CoreError;
use svbrdf_core::model::scene::Scene;
use svbrdf_core::picture::difference::Difference;
use svbrdf_evaluate::photograph::{self, Corners, PhotoReport, PhotoSetting};
use svbrdf_files::read::{PhotographOptions, read_photograph};

use crate::arrays;
use crate::errors::exception;
use crate::material::CoreMaterial;
use crate::model::SceneTuple;
use crate::report::Views;
use crate::work;

/// The photograph, and how it is compared.
#[derive(Debug, FromPyObject)]
#[pyo3(from_item_all)]
pub struct PhotoAsked {
    photo: PathBuf,
    /// Of the materials.
    names: Vec<String>,
    scene: Option<SceneTuple>,
    /// In degrees: the light is a flash at the camera.
    fov: Option<f64>,
    corners: Option<[[f64; 2]; 4]>,
    transfer: Option<String>,
    clip: Option<f64>,
    falloff: bool,
    difference: String,
    convention: String,
}

/// The comparison with a photograph.
#[derive(Debug, IntoPyObject)]
pub struct PhotoItems<'py> {
    views: Views,
    /// In the order of the results, (width, height) and height x width x 3 in f32, NaN where the photograph is clipped.
    differences: Vec<([usize; 2], Bound<'py, PyByteArray>)>,
}

impl PhotoAsked {
    fn scene(&self) -> PyResult<Scene> {
        match (&self.scene, self.fov) {
            (Some(scene), _) => scene.scene(),
            (None, fov) => photograph::flash(fov.unwrap_or_default()).map_err(exception),
        }
    }

    fn difference(&self) -> PyResult<Difference> {
        let known = PhotoReport::DIFFERENCES;
        known.into_iter().find(|kind| kind.key() == self.difference).ok_or_else(|| {
            exception(CoreError::UnknownName {
                what: "difference",
                found: self.difference.clone(),
                known: known.map(Difference::key).join(", "),
            })
        })
    }
}

/// The differences of renderings of `materials` from a photograph.
#[pyfunction]
pub fn photo<'py>(
    py: Python<'py>,
    materials: Vec<PyRef<'_, CoreMaterial>>,
    asked: PhotoAsked,
    progress: Option<&Bound<'_, PyAny>>,
) -> PyResult<PhotoItems<'py>> {
    let (scene, kind) = (asked.scene()?, asked.difference()?);
    let convention = asked.convention.parse().map_err(exception)?;
    let transfer = asked.transfer.as_deref().map(str::parse).transpose().map_err(exception)?;
    let options = PhotographOptions { transfer, clip: asked.clip, light_colour: None };
    let photograph = work::run(py, None, |_| read_photograph(&asked.photo, &options))?;
    let setting = PhotoSetting {
        name: asked.photo.display().to_string(),
        corners: asked.corners.map_or_else(|| Corners::whole(photograph.size()), Corners),
        photograph,
        falloff: asked.falloff,
        scene,
        convention,
    };
    let materials: Vec<_> = materials.iter().map(|material| material.single()).collect();
    let named = asked.names.iter().zip(&materials).map(|(name, material)| (name.as_str(), material));
    let report = work::run(py, progress, |progress| PhotoReport::new(setting, named, progress))?;
    let differences = report.results.iter().map(|result| {
        let image = result.compared.difference(kind);
        let size = [image.width, image.height];
        Ok((size, arrays::bytes(py, 3 * image.pixels.len(), image.pixels.into_iter().flatten())?))
    });
    Ok(PhotoItems { views: Views::new(&report)?, differences: differences.collect::<PyResult<_>>()? })
}
