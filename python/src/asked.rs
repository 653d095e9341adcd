//! The arguments that the comparisons have in common.

use std::path::Path;

use pyo3::prelude::*;
use serde_json::{Map, Value};
use svbrdf_core::loss::LossOptions;
use svbrdf_core::material::Material;
use svbrdf_core::math::real::Real;
use svbrdf_core::model::convention::Convention;
use svbrdf_core::text::of_json;
use svbrdf_evaluate::analyses::options_of;
use svbrdf_files::{convention, scene_file};

use crate::errors::{Error, exception};
use crate::material::CoreMaterial;

/// A question, which is JSON.
///
/// # Errors
/// Where it is no object.
pub fn question(text: &str) -> PyResult<Map<String, Value>> {
    serde_json::from_str(text).map_err(|problem| Error::new_err(of_json(&problem)))
}

/// The options of the scenes of a question, whose `scenes` are the path of a file.
///
/// # Errors
/// By its name, where one is unknown, or has a wrong type or makes no sense; of the file.
pub fn options(mut given: Map<String, Value>) -> PyResult<LossOptions> {
    let path = given.remove("scenes");
    let options: LossOptions = options_of(given.into()).map_err(exception)?;
    let Some(path) = path.as_ref().and_then(Value::as_str) else { return Ok(options) };
    let file = Some(scene_file::read_named(Path::new(path)).map_err(exception)?);
    Ok(LossOptions { file, ..options })
}

/// Materials, names, convention and question.
#[derive(Debug, FromPyObject)]
#[pyo3(from_item_all)]
pub struct Asked<'py> {
    /// The ground truth, then the predictions.
    pub materials: Vec<Bound<'py, CoreMaterial>>,
    /// Of the materials.
    pub names: Vec<String>,
    /// Where they were read from.
    pub paths: Vec<Option<String>>,
    pub convention: String,
    pub precision: String,
    /// [`LossOptions`], and the own ones of an analysis, as JSON.
    pub question: String,
}

impl Asked<'_> {
    /// The convention of its name.
    ///
    /// # Errors
    /// Where there is none.
    pub fn convention(&self) -> PyResult<Convention> {
        convention::of_loss(&self.convention).map_err(exception)
    }

    /// The materials as the report calls them: each as `of` takes it from Python.
    pub fn materials<T: Real>(&self, of: impl Fn(&CoreMaterial) -> Material<T>) -> Vec<Material<T>> {
        let all = self.materials.iter().zip(&self.names);
        all.map(|(material, name)| of(material.get()).renamed(name)).collect()
    }
}
