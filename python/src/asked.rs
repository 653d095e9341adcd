//! The arguments that the comparisons have in common.

use pyo3::prelude::*;
use serde_json::Value;
use svbrdf_core::loss::{LossOptions, Request};
use svbrdf_core::material::Material;
use svbrdf_core::math::real::Real;
use svbrdf_core::model::convention::Convention;
use svbrdf_files::convention;

use crate::errors::{Error, exception};
use crate::material::CoreMaterial;

/// The options of a question, which are JSON.
///
/// # Errors
/// Where a word is none of the known ones.
pub fn options(question: &str) -> PyResult<LossOptions> {
    let options = serde_json::from_str::<Value>(question).and_then(serde_json::from_value);
    options.map_err(|problem| Error::new_err(problem.to_string()))
}

/// Names, convention and question.
#[derive(Debug, FromPyObject)]
#[pyo3(from_item_all)]
pub struct Asked {
    /// Of the ground truth, then of each prediction.
    pub names: Vec<String>,
    /// Where they were read from.
    pub paths: Vec<Option<String>>,
    pub convention: String,
    pub precision: String,
    /// [`LossOptions`] as JSON.
    question: String,
}

impl Asked {
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

    /// The ground truth and the predictions of a comparison as the report calls them: each as `of` takes it from Python.
    pub fn materials<T: Real>(
        &self,
        ground_truth: &CoreMaterial,
        predictions: &[PyRef<'_, CoreMaterial>],
        of: impl Fn(&CoreMaterial) -> Material<T>,
    ) -> Vec<Material<T>> {
        let all = std::iter::once(ground_truth).chain(predictions.iter().map(|prediction| &**prediction));
        all.zip(&self.names).map(|(material, name)| of(material).renamed(name)).collect()
    }

    /// [`Asked::materials`] in f32.
    pub fn singles(
        &self,
        ground_truth: &CoreMaterial,
        predictions: &[PyRef<'_, CoreMaterial>],
    ) -> Vec<Material<f32>> {
        self.materials(ground_truth, predictions, CoreMaterial::single)
    }
}
