//! The scenes of every material of a data set, where a number or a list of them is asked for.

use serde::Serialize;
use serde_json::{Value, json};

use svbrdf_core::loss::{Request, Sampling};
use svbrdf_core::model::sampler::Sampler;

use crate::error::Error;
use crate::report::scenes_line;

/// Scenes that every material is compared in, in place of as many as an accuracy needs.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct FixedScenes {
    /// The options of the command line that ask for them.
    pub options: Vec<String>,
    #[serde(skip)]
    request: Request,
}

impl FixedScenes {
    /// Those of `request`, which `options` of the command line ask for; `None` where an accuracy or a time decides them.
    ///
    /// # Errors
    /// [`Error::OneScene`].
    pub fn new(request: Request, options: Vec<String>) -> Result<Option<Self>, Error> {
        match &request {
            Request::Scenes(Sampling { near: 1, .. }) => Err(Error::OneScene { option: "near" }),
            Request::Scenes(Sampling { distant: 1, .. }) => Err(Error::OneScene { option: "distant" }),
            Request::Scenes(_) | Request::Listed(_) => Ok(Some(Self { options, request })),
            Request::Accuracy { .. } | Request::Time { .. } => Ok(None),
        }
    }

    /// The request of a material whose scenes are named by `seed`.
    pub(super) fn request(&self, seed: u64) -> Request {
        match &self.request {
            Request::Scenes(sampling) => Request::Scenes(Sampling { seed, ..*sampling }),
            listed => listed.clone(),
        }
    }

    /// What a loss depends on, but for the seed.
    pub(super) fn key(&self) -> Value {
        match &self.request {
            Request::Scenes(Sampling { near, distant, sampler, .. }) => json!([near, distant, sampler]),
            Request::Listed(scenes) => json!(scenes),
            Request::Accuracy { .. } | Request::Time { .. } => Value::Null,
        }
    }

    /// Their numbers, and the name of a set; the `seed` of those that are sampled.
    pub(super) fn description(&self, seed: u64) -> String {
        match &self.request {
            Request::Scenes(Sampling { near, distant, sampler, .. }) => {
                let sobol = if *sampler == Sampler::Sobol { ", scrambled Sobol" } else { "" };
                format!("{near} near-field and {distant} distant scenes each{sobol}, seed {seed}")
            }
            Request::Listed(scenes) => scenes_line(None, scenes, [0; 2]).trim_end().to_owned(),
            Request::Accuracy { .. } | Request::Time { .. } => String::new(),
        }
    }
}
