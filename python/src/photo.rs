//! Materials against a photograph, or against all photographs of a capture.

use std::path::PathBuf;

use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyByteArray;
use svbrdf_core::error::Error as CoreError;
use svbrdf_core::picture::difference::Difference;
use svbrdf_evaluate::photograph::{PhotoReport, PhotoSetting};
use svbrdf_files::convention;
use svbrdf_files::photograph::{Capture, Corners, SessionPhotograph};
use svbrdf_files::read::PhotographOptions;
use svbrdf_files::scene_file::PhotographLight;

use crate::arrays;
use crate::errors::exception;
use crate::material::CoreMaterial;
use crate::model::SceneTuple;
use crate::report::Views;
use crate::work;

/// The photographs, and how they are compared.
#[derive(Debug, FromPyObject)]
#[pyo3(from_item_all)]
pub struct PhotoAsked {
    photo: PathBuf,
    /// Of the materials.
    names: Vec<String>,
    scene: Option<SceneTuple>,
    scene_file: Option<PathBuf>,
    scene_number: Option<usize>,
    /// In degrees: the light is a flash at the camera.
    fov: Option<f64>,
    corners: Option<[[f64; 2]; 4]>,
    transfer: Option<String>,
    clip: Option<f64>,
    falloff: bool,
    exposure: Option<String>,
    hold_out: Vec<String>,
    difference: String,
    convention: String,
}

/// The comparison with photographs.
#[derive(Debug, IntoPyObject)]
pub struct PhotoItems<'py> {
    views: Views,
    /// From a single photograph, in the order of the results: (width, height) and height x width x 3 in f32, NaN where the photograph is
    /// clipped.
    differences: Vec<([usize; 2], Bound<'py, PyByteArray>)>,
}

impl PhotoAsked {
    fn capture(&self) -> PyResult<Capture> {
        let transfer = self.transfer.as_deref().map(str::parse).transpose().map_err(exception)?;
        let read = PhotographOptions { transfer, clip: self.clip, light_colour: None };
        match self.light()?.map(|light| light.scene()).transpose().map_err(exception)? {
            Some(_) if self.exposure.is_some() || !self.hold_out.is_empty() => {
                Err(PyValueError::new_err("exposure and hold_out: expected only with a capture"))
            }
            Some(scene) => {
                let (path, falloff, corners) = (self.photo.clone(), self.falloff, self.corners.map(Corners));
                let photograph = SessionPhotograph { path, read, corners, falloff, capture: None };
                Ok(Capture::of_one(photograph, scene))
            }
            None if !Capture::is_named(&self.photo) => Err(PyValueError::new_err(
                "light and view of the photograph: expected either scene, or flash with fov, or a capture",
            )),
            None if self.corners.is_some() || self.falloff => Err(PyValueError::new_err(
                "corners and falloff: expected only with a single photograph; a capture has its own",
            )),
            None => Ok(Capture::read(&self.photo).map_err(exception)?.with_options(&read)),
        }
    }

    fn light(&self) -> PyResult<Option<PhotographLight>> {
        let scene = self.scene.as_ref().map(SceneTuple::scene).transpose()?.map(PhotographLight::Scene);
        let file = |path: &PathBuf| PhotographLight::File { path: path.clone(), number: self.scene_number };
        let flash = self.fov.map(|fov_degrees| PhotographLight::Flash { fov_degrees });
        Ok(scene.or(self.scene_file.as_ref().map(file)).or(flash))
    }

    fn setting(&self) -> PyResult<PhotoSetting> {
        let exposure = self.exposure.as_deref().map(str::parse).transpose().map_err(exception)?;
        let convention = convention::of_loss(&self.convention).map_err(exception)?;
        let (capture, exposure) = (self.capture()?, exposure.unwrap_or_default());
        PhotoSetting::new(capture, exposure, &self.hold_out, convention).map_err(exception)
    }

    fn difference(&self) -> PyResult<Difference> {
        let known = PhotoSetting::DIFFERENCES;
        known.into_iter().find(|kind| kind.key() == self.difference).ok_or_else(|| {
            exception(CoreError::unknown_name(
                "difference",
                &self.difference,
                known.map(Difference::key).join(", "),
            ))
        })
    }
}

/// The differences of renderings of `materials` from photographs.
#[pyfunction]
pub fn photo<'py>(
    py: Python<'py>,
    materials: Vec<PyRef<'_, CoreMaterial>>,
    asked: PhotoAsked,
    progress: Option<&Bound<'_, PyAny>>,
) -> PyResult<PhotoItems<'py>> {
    let (setting, kind) = (asked.setting()?, asked.difference()?);
    let materials: Vec<_> = materials.iter().map(|material| material.single()).collect();
    let named = asked.names.iter().zip(&materials).map(|(name, material)| (name.as_str(), material));
    let report = work::run(py, progress, |progress| PhotoReport::new(setting, named, progress))?;
    let differences = report.compared().map(|compared| {
        let image = compared.difference(kind);
        let size = [image.width, image.height];
        Ok((size, arrays::bytes(py, 3 * image.pixels.len(), image.pixels.into_iter().flatten())?))
    });
    Ok(PhotoItems { views: Views::new(&report)?, differences: differences.collect::<PyResult<_>>()? })
}
