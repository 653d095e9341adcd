//! An analysis: a report, and the declaration that its command, its function in Python, its JSON Schema and its table in the window follow
//! from.

use serde::Serialize;
use serde::de::DeserializeOwned;

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

/// Options of [`LossOptions`](svbrdf_core::loss::LossOptions) that an analysis has.
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
pub trait Analysis: Report + Schematic + Sized + 'static {
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
    type Options: Default + DeserializeOwned + Schematic;
    /// What the command line says of them.
    const OPTIONS: &'static [AnalysisOption];

    /// The answer.
    ///
    /// # Errors
    /// Where the materials cannot be compared; [`Cancelled`](Error::is_cancelled).
    fn run(input: &AnalysisInput<'_>, options: &Self::Options, progress: &Progress) -> Result<Self, Error>;
}

/// No options.
#[derive(Clone, Copy, Debug, Default, serde::Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct NoOptions {}

/// An option of an analysis itself, which is a number.
#[derive(Clone, Copy, Debug)]
pub struct AnalysisOption {
    /// The name of its field.
    pub name: &'static str,
    pub about: &'static str,
    pub default: f64,
    /// Whether it is a share, written as percent, and not a count.
    pub is_share: bool,
}

/// What has a JSON Schema where the feature `schema` is on: all reports and their options.
#[cfg(feature = "schema")]
pub use schemars::JsonSchema as Schematic;
/// All reports and their options.
#[cfg(not(feature = "schema"))]
pub trait Schematic {}
#[cfg(not(feature = "schema"))]
impl<T> Schematic for T {}
