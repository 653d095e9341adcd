//! The arguments that the comparisons have in common.

use std::time::Duration;

use pyo3::prelude::*;
use svbrdf_core::loss::{Outcome, Question, Request, SceneChoice};
use svbrdf_core::material::Material;
use svbrdf_core::math::real::Real;
use svbrdf_core::model::convention::Convention;
use svbrdf_core::report::Compared;

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

    /// The first lines of a report on comparisons with `ground_truth`.
    pub fn compared<T: Real>(&self, ground_truth: &Material<T>, convention: &Convention) -> Compared {
        let compared = Compared::new(ground_truth, convention);
        Compared { ground_truth: self.names.first().cloned().unwrap_or_default(), ..compared }
    }

    /// The names of the predictions.
    pub fn predictions(&self) -> &[String] {
        self.names.get(1..).unwrap_or_default()
    }

    /// The outcome with the names of the predictions.
    pub fn named(&self, mut outcome: Outcome) -> Outcome {
        for (loss, name) in outcome.losses.iter_mut().zip(self.predictions()) {
            loss.prediction.clone_from(name);
        }
        outcome
    }
}

/// The ground truth and the predictions of a comparison in f32: copies only of those in f64.
pub fn singles<'a>(
    ground_truth: &'a CoreMaterial,
    predictions: &'a [PyRef<'_, CoreMaterial>],
) -> Vec<std::borrow::Cow<'a, Material<f32>>> {
    std::iter::once(ground_truth).chain(predictions.iter().map(|p| &**p)).map(CoreMaterial::single).collect()
}
