//! The arguments that the comparisons have in common.

use std::path::Path;

use pyo3::prelude::*;
use serde_json::{Map, Value};
use svbrdf_core::loss::LossOptions;
use svbrdf_core::material::{Mask, Material};
use svbrdf_core::math::real::Real;
use svbrdf_core::model::convention::Convention;
use svbrdf_core::text::of_json;
use svbrdf_evaluate::analyses::options_of;
use svbrdf_evaluate::registration::{Registered, Registration, registered};
use svbrdf_files::{convention, scene_file};

use crate::arrays;
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
    /// How predictions of another size lie on the ground truth; `None`: found by the maps.
    pub register: Option<String>,
    /// Which texels are compared: an array of booleans of the size of the ground truth.
    pub mask: Option<Bound<'py, PyAny>>,
}

impl Asked<'_> {
    /// The convention of its name.
    ///
    /// # Errors
    /// Where there is none.
    pub fn convention(&self) -> PyResult<Convention> {
        convention::of_loss(&self.convention).map_err(exception)
    }

    /// The materials as the report calls them, each as `of` takes it from Python, brought to one size with the mask.
    ///
    /// # Errors
    /// Where the mask keeps no texel, or predictions are no such part.
    pub fn materials<T: Real>(&self, of: impl Fn(&CoreMaterial) -> Material<T>) -> PyResult<Registered<T>> {
        let all = self.materials.iter().zip(&self.names);
        let materials: Vec<_> = all.map(|(material, name)| of(material.get()).renamed(name)).collect();
        let way = self.register.as_deref().map(str::parse::<Registration>).transpose().map_err(exception)?;
        let none_kept =
            || Error::new_err("mask: expected a texel of the predictions that is compared, found none");
        let mask = |array| Mask::new(materials[0].size(), arrays::plane(array)?).ok_or_else(none_kept);
        let mask = self.mask.as_ref().map(mask).transpose()?;
        let is_masked = mask.is_some();
        let found = registered(materials, mask, way.as_slice()).map_err(exception)?;
        if is_masked && found.mask.is_none() { Err(none_kept()) } else { Ok(found) }
    }
}
