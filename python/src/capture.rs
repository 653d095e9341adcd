//! Materials against the photographs of a capture.

use std::path::PathBuf;

use pyo3::prelude::*;
use svbrdf_evaluate::capture::{Capture, CaptureReport, CaptureSetting};
use svbrdf_files::read::PhotographOptions;

use crate::errors::exception;
use crate::material::CoreMaterial;
use crate::report::Views;
use crate::work;

/// The capture, and how it is compared.
#[derive(Debug, FromPyObject)]
#[pyo3(from_item_all)]
pub struct CaptureAsked {
    capture: PathBuf,
    /// Of the materials.
    names: Vec<String>,
    exposure: String,
    hold_out: Vec<String>,
    transfer: Option<String>,
    clip: Option<f64>,
    convention: String,
}

impl CaptureAsked {
    fn setting(&self) -> PyResult<CaptureSetting> {
        let transfer = self.transfer.as_deref().map(str::parse).transpose().map_err(exception)?;
        let mut capture = Capture::read(&self.capture).map_err(exception)?;
        capture.set_options(&PhotographOptions { transfer, clip: self.clip, light_colour: None });
        let name = self.capture.display().to_string();
        let exposure = self.exposure.parse().map_err(exception)?;
        let convention = self.convention.parse().map_err(exception)?;
        CaptureSetting::new(name, capture, exposure, &self.hold_out, convention).map_err(exception)
    }
}

/// The differences of renderings of `materials` from the photographs of a capture.
#[pyfunction]
pub fn capture(
    py: Python<'_>,
    materials: Vec<PyRef<'_, CoreMaterial>>,
    asked: CaptureAsked,
    progress: Option<&Bound<'_, PyAny>>,
) -> PyResult<Views> {
    let setting = asked.setting()?;
    let materials: Vec<_> = materials.iter().map(|material| material.single()).collect();
    let named = asked.names.iter().zip(&materials).map(|(name, material)| (name.as_str(), material));
    let report = work::run(py, progress, |progress| CaptureReport::new(setting, named, progress))?;
    Views::new(&report)
}
