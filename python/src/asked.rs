//! The arguments that the comparisons have in common.

use std::time::Duration;

use pyo3::prelude::*;
use svbrdf_core::loss::{Question, Request, SceneChoice};
use svbrdf_core::material::Material;
use svbrdf_core::math::real::Real;
use svbrdf_core::model::convention::Convention;

use crate::errors::exception;
use crate::material::CoreMaterial;
use crate::model::SceneTuple;

/// Names, convention and scenes.
#[derive(Debug, FromPyObject)]
#[pyo3(from_item_all)]
pub struct Asked {
    /// Of the ground truth, then of each prediction.
    pub names: Vec<String>,
    /// Where they were read from.
    pub paths: Vec<Option<String>>,
    pub convention: String,
    pub precision: String,
    pub seed: u64,
    near: Option<usize>,
    distant: Option<usize>,
    sampler: Option<String>,
    texels: Option<String>,
    target_error: Option<f64>,
    /// In seconds.
    time_budget: Option<f64>,
    scenes: Option<Vec<SceneTuple>>,
}

impl Asked {
    /// The convention of its name.
    ///
    /// # Errors
    /// Where there is none.
    pub fn convention(&self) -> PyResult<Convention> {
        self.convention.parse().map_err(exception)
    }

    /// The question: the default where nothing chooses scenes.
    ///
    /// # Errors
    /// Where a word is none of the known ones.
    pub fn question(&self) -> PyResult<Question> {
        let Self { near, distant, sampler, texels, seed, .. } = self;
        let request = if let Some(scenes) = &self.scenes {
            Request::Listed(scenes.iter().map(SceneTuple::scene).collect::<PyResult<_>>()?)
        } else if let Some(target) = self.target_error {
            Request::Accuracy { target, seed: *seed }
        } else if let Some(seconds) = self.time_budget {
            Request::Time { budget: Duration::from_secs_f64(seconds), seed: *seed }
        } else {
            let (sampler, texels) = (sampler.as_ref(), texels.as_ref());
            let choice = SceneChoice {
                near: *near,
                distant: *distant,
                sampler: sampler.map(|name| name.parse()).transpose().map_err(exception)?,
                texels: texels.map(|text| text.parse()).transpose().map_err(exception)?,
            };
            return choice.question(*seed).map_err(exception);
        };
        Ok(request.into())
    }

    /// The request for the scenes.
    ///
    /// # Errors
    /// As [`Asked::question`].
    pub fn request(&self) -> PyResult<Request> {
        Ok(self.question()?.request)
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
