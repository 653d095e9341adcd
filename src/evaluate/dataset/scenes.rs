//! The accuracy or the scenes of the losses of a data set.

use serde::ser::SerializeMap as _;
use serde::{Serialize, Serializer};
use serde_json::{Value, json};

use svbrdf_core::loss::{LossOptions, Request, Sampling};
use svbrdf_core::model::sampler::Sampler;

use crate::error::Error;
use crate::report::scenes_line;

/// What is asked of the loss of every material, but for the seed.
#[derive(Clone, Debug, PartialEq)]
pub struct DatasetScenes {
    request: Request,
    /// The options of the command line that ask for scenes.
    pub(super) options: Vec<String>,
}

impl From<Request> for DatasetScenes {
    fn from(request: Request) -> Self {
        Self { request, options: Vec::new() }
    }
}

/// The accuracy as `target_error`, and `scenes` where there is none.
impl Serialize for DatasetScenes {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(None)?;
        map.serialize_entry("target_error", &self.target())?;
        if self.target().is_none() {
            map.serialize_entry("scenes", &json!({ "options": self.options }))?;
        }
        map.end()
    }
}

impl DatasetScenes {
    /// Those that `options` ask for.
    ///
    /// # Errors
    /// As [`LossOptions::request`]; [`Error::OneScene`].
    pub(super) fn new(options: &LossOptions) -> Result<Self, Error> {
        match options.request()? {
            Request::Scenes(Sampling { near: 1, .. }) => Err(Error::OneScene { option: "near" }),
            Request::Scenes(Sampling { distant: 1, .. }) => Err(Error::OneScene { option: "distant" }),
            request => Ok(Self { request, options: options.words() }),
        }
    }

    /// Half of the 95% interval of each loss over scenes, as a share of the loss; `None` for fixed scenes.
    pub fn target(&self) -> Option<f64> {
        self.request.target()
    }

    /// The request of a material whose scenes are named by `seed`.
    pub(super) fn of_seed(&self, seed: u64) -> Request {
        self.request.clone().of_seed(seed)
    }

    /// The fixed scenes that a loss depends on, but for the seed.
    pub(super) fn key(&self) -> Option<Value> {
        match &self.request {
            Request::Scenes(Sampling { near, distant, sampler, .. }) => Some(json!([near, distant, sampler])),
            Request::Listed(scenes) => Some(json!(scenes)),
            Request::Accuracy { .. } | Request::Time { .. } => None,
        }
    }

    /// The accuracy, or the numbers of scenes and the name of a set, for people; the `seed` of those that are sampled.
    pub fn description(&self, seed: u64) -> String {
        match &self.request {
            Request::Scenes(Sampling { near, distant, sampler, .. }) => {
                let sobol = if *sampler == Sampler::Sobol { ", scrambled Sobol" } else { "" };
                format!("{near} near-field and {distant} distant scenes each{sobol}, seed {seed}")
            }
            Request::Listed(scenes) => scenes_line(None, scenes, [0; 2]).trim_end().to_owned(),
            Request::Accuracy { target, .. } => format!("+-{}% per loss, seed {seed}", 100.0 * target),
            Request::Time { budget, .. } => format!("{} s per loss, seed {seed}", budget.as_secs_f64()),
        }
    }
}
