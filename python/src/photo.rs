//! Materials against a photograph, or against several of one material.

use std::path::PathBuf;

use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use svbrdf_evaluate::photograph::PhotoReport;
use svbrdf_files::convention;
use svbrdf_files::photograph::{Capture, SessionPhotograph};

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
    transfer: Option<String>,
    falloff: bool,
    convention: String,
}

impl PhotoAsked {
    fn capture(&self) -> PyResult<Capture> {
        let transfer = self.transfer.as_deref().map(str::parse).transpose().map_err(exception)?;
        let (path, falloff) = (self.photo.clone(), self.falloff);
        match &self.scene {
            Some(scene) => Ok(Capture::of_one(SessionPhotograph { path, transfer, falloff }, scene.scene()?)),
            None if !Capture::is_named(&path) => Err(PyValueError::new_err(
                "light and view of the photograph: expected a scene, or a list of photographs",
            )),
            None if falloff || transfer.is_some() => Err(PyValueError::new_err(
                "falloff and transfer: expected only with a single photograph; a list has its own",
            )),
            None => Capture::read(&path).map_err(exception),
        }
    }
}

/// The differences of renderings of `materials` from photographs.
#[pyfunction]
pub fn photo(
    py: Python<'_>,
    materials: Vec<PyRef<'_, CoreMaterial>>,
    asked: PhotoAsked,
    progress: Option<&Bound<'_, PyAny>>,
) -> PyResult<Views> {
    let capture = asked.capture()?;
    let convention = convention::of_loss(&asked.convention).map_err(exception)?;
    let materials: Vec<_> = materials.iter().map(|material| material.single()).collect();
    let named = asked.names.iter().zip(&materials).map(|(name, material)| (name.as_str(), material));
    let report =
        work::run(py, progress, |progress| PhotoReport::new(&capture, named, &convention, progress))?;
    Views::new(&report)
}
