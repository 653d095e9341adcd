//! Session files: comparisons that the window opens.

use std::path::PathBuf;

use pyo3::prelude::*;
use svbrdf_files::convention::ChosenConvention;
use svbrdf_files::read::{ReadOptions, Sidecar};
use svbrdf_files::session::{Session, SessionMaterial};

use crate::errors::exception;
use crate::material::read_options;
use crate::model::SceneTuple;

/// The text of the session file `path`.
///
/// `materials` are paths, the ground truth first, each with its read options as JSON; without, those of its sidecar file.
#[pyfunction]
pub fn session(
    path: PathBuf,
    materials: Vec<(PathBuf, Option<String>)>,
    scene: SceneTuple,
    convention: &str,
) -> PyResult<String> {
    let scene = scene.scene()?;
    let convention = ChosenConvention::read(convention).map_err(exception)?;
    let entry = |(path, options): (PathBuf, Option<String>)| {
        let read: ReadOptions = match options {
            Some(options) => read_options(&options)?,
            None => Sidecar::load(&path).map_err(exception)?.options,
        };
        Ok(SessionMaterial { name: None, path: Some(path), built_in: None, read, fit: false })
    };
    let materials = materials.into_iter().map(entry).collect::<PyResult<_>>()?;
    Session::new(materials, scene, convention.text(), 0.0).text(&path).map_err(exception)
}
