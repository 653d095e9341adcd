//! An analysis: a report, and the declaration that its command, its function in Python, its JSON Schema and its table in the window follow
//! from.

use schemars::generate::SchemaSettings;
use schemars::transform::RecursiveTransform;
use schemars::{JsonSchema, Schema};
use serde::Serialize;
use serde::de::DeserializeOwned;
use serde_json::Value;

use svbrdf_core::loss::Request;
use svbrdf_core::material::Material;
use svbrdf_core::model::convention::Convention;
use svbrdf_core::progress::Progress;

use super::Report;
use super::heading::Compared;
use crate::error::Error;

/// A comparison of predictions with their ground truth.
#[derive(Clone, Debug)]
pub struct AnalysisInput<'a> {
    pub ground_truth: &'a Material<f32>,
    pub predictions: Vec<&'a Material<f32>>,
    pub convention: Convention,
    /// Its scenes.
    pub request: Request,
}

impl AnalysisInput<'_> {
    /// The settings of a report.
    pub fn compared(&self) -> Compared {
        Compared::new(self.ground_truth, &self.convention)
    }

    /// What `of` computes for each prediction.
    ///
    /// # Errors
    /// Its first.
    pub fn each<T>(&self, of: impl Fn(&Material<f32>) -> Result<T, Error>) -> Result<Vec<T>, Error> {
        self.predictions.iter().map(|prediction| of(prediction)).collect()
    }

    /// Names the sampled scenes; 0 for listed ones.
    pub fn seed(&self) -> u64 {
        self.request.seed().unwrap_or(0)
    }
}

/// Options of [`LossOptions`] that an analysis has.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum SceneOptions {
    /// The seed.
    Seed,
    /// The accuracy of the loss.
    TargetError,
    /// The numbers of scenes, and their sampler: each is rendered on all texels.
    Sampled,
    /// The scenes of a list.
    List,
}

/// An analysis of predictions: the report that it gives, and what it is called.
pub trait Analysis: Report + JsonSchema + Sized + 'static {
    /// Of its command, its function and its schema.
    const NAME: &'static str;
    /// Its question in the window.
    const TITLE: &'static str;
    /// What it does: one line.
    const ABOUT: &'static str;
    /// What its numbers mean.
    const DETAILS: &'static str;
    /// What it does while it runs.
    const DOING: &'static str;
    /// The options of its scenes.
    const SCENES: &'static [SceneOptions];
    /// Its own options: numbers with doc comments and defaults.
    type Options: Default + DeserializeOwned + JsonSchema;

    /// The answer.
    ///
    /// # Errors
    /// Where the materials cannot be compared; [`Error::Cancelled`].
    fn run(input: &AnalysisInput<'_>, options: &Self::Options, progress: &Progress) -> Result<Self, Error>;
}

/// No options.
#[derive(Clone, Copy, Debug, Default, serde::Deserialize, JsonSchema)]
pub struct NoOptions {}

/// The schema of what is written, not of what could be read.
pub fn schema_of<T: JsonSchema>() -> Schema {
    let settings = SchemaSettings::draft2020_12().for_serialize();
    settings.with_transform(RecursiveTransform(reworded)).into_generator().into_root_schema_for::<T>()
}

/// A doc comment for readers of JSON: on one line, with null in place of `None`.
fn reworded(schema: &mut Schema) {
    if let Some(Value::String(text)) = schema.get_mut("description") {
        *text = text.replace('\n', " ").replace("`None`", "null").replace("[`", "`").replace("`]", "`");
    }
}
