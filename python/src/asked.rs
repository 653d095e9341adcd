//! The arguments that the comparisons have in common.

use std::time::Duration;

use pyo3::prelude::*;
use serde_json::{Map, Value};
use svbrdf_core::loss::{LossOptions, Request};
use svbrdf_core::material::Material;
use svbrdf_core::math::real::Real;
use svbrdf_core::model::convention::Convention;
use svbrdf_core::text::of_json;
use svbrdf_files::convention;

use crate::errors::{Error, exception};
use crate::material::CoreMaterial;

/// The longest time budget.
const DAY: Duration = Duration::from_secs(86_400);

/// The options of a question, which are JSON.
///
/// # Errors
/// By its name, where one is unknown, or has a wrong type or makes no sense.
pub fn options(question: &str) -> PyResult<LossOptions> {
    let of = |given: Map<String, Value>| serde_json::from_value::<LossOptions>(given.into());
    let wrong = |name: &str, problem: String| Error::new_err(format!("{name}: {problem}"));
    let given: Map<String, Value> =
        serde_json::from_str(question).map_err(|e| wrong("question", of_json(&e)))?;
    for (name, value) in &given {
        of(Map::from_iter([(name.clone(), value.clone())])).map_err(|e| wrong(name, of_json(&e)))?;
    }
    let options = of(given).map_err(|e| wrong("question", of_json(&e)))?;
    if let Some(target) = options.target_error.filter(|target| !(*target > 0.0 && *target <= 0.1)) {
        let problem = format!("expected a share above 0, at most 0.1, such as 0.01 for 1%, found {target}");
        return Err(wrong("target_error", problem));
    }
    if options.time_budget.is_some_and(|budget| budget.is_zero() || budget > DAY) {
        return Err(wrong("time_budget", "expected seconds above 0, at most a day".to_owned()));
    }
    Ok(options)
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
    /// [`LossOptions`] as JSON.
    question: String,
}

impl Asked<'_> {
    /// The convention of its name.
    ///
    /// # Errors
    /// Where there is none.
    pub fn convention(&self) -> PyResult<Convention> {
        convention::of_loss(&self.convention).map_err(exception)
    }

    /// The options of the question.
    ///
    /// # Errors
    /// As [`options`].
    pub fn options(&self) -> PyResult<LossOptions> {
        options(&self.question)
    }

    /// The seed of the question.
    ///
    /// # Errors
    /// As [`Asked::options`].
    pub fn seed(&self) -> PyResult<u64> {
        Ok(self.options()?.seed.unwrap_or(0))
    }

    /// The request of the question.
    ///
    /// # Errors
    /// As [`LossOptions::question`].
    pub fn request(&self) -> PyResult<Request> {
        Ok(self.options()?.question().map_err(exception)?.request)
    }

    /// The request for scenes that are listed one by one.
    ///
    /// # Errors
    /// As [`LossOptions::listed`].
    pub fn listed(&self) -> PyResult<Request> {
        self.options()?.listed().map_err(exception)
    }

    /// The materials as the report calls them: each as `of` takes it from Python.
    pub fn materials<T: Real>(&self, of: impl Fn(&CoreMaterial) -> Material<T>) -> Vec<Material<T>> {
        let all = self.materials.iter().zip(&self.names);
        all.map(|(material, name)| of(material.get()).renamed(name)).collect()
    }

    /// [`Asked::materials`] in f32.
    pub fn singles(&self) -> Vec<Material<f32>> {
        self.materials(CoreMaterial::single)
    }
}
