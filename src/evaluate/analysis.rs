//! Analyses of predictions, each declared once, beside its report: from the declaration follow its command, its function in Python, its
//! JSON Schema, and its table in the window.

use schemars::{JsonSchema, Schema};
use serde::Serialize;
use serde::de::DeserializeOwned;
use serde_json::Value;

use crate::error::Error;
use svbrdf_core::error::Error as CoreError;
use svbrdf_core::loss::{LossOptions, Request};
use svbrdf_core::material::Material;
use svbrdf_core::model::convention::Convention;
use svbrdf_core::progress::Progress;
use svbrdf_files::Error as FilesError;

use crate::report::{BlameReport, Compared, MetricsReport, Report, ScenesReport, WorstReport};
use crate::schema;

/// All of them, in the order of the commands.
pub const ANALYSES: [AnyAnalysis; 4] = [
    AnyAnalysis::of::<BlameReport>(),
    AnyAnalysis::of::<ScenesReport>(),
    AnyAnalysis::of::<WorstReport>(),
    AnyAnalysis::of::<MetricsReport>(),
];

/// A comparison of predictions with their ground truth.
#[derive(Clone, Debug)]
pub struct Subject<'a> {
    pub ground_truth: &'a Material<f32>,
    pub predictions: Vec<&'a Material<f32>>,
    pub convention: Convention,
    /// The scenes that [`Analysis::request`] gives.
    pub request: Request,
}

impl Subject<'_> {
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
    /// Options of an example.
    const EXAMPLE: &'static str = "";
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
    fn run(subject: &Subject<'_>, options: &Self::Options, progress: &Progress) -> Result<Self, Error>;
}

/// No options.
#[derive(Clone, Copy, Debug, Default, serde::Deserialize, JsonSchema)]
pub struct NoOptions {}

/// One of the [`ANALYSES`].
#[derive(Clone, Copy, Debug)]
pub struct AnyAnalysis {
    pub name: &'static str,
    pub title: &'static str,
    pub about: &'static str,
    pub details: &'static str,
    pub example: &'static str,
    pub doing: &'static str,
    pub scenes: &'static [SceneOptions],
    /// The schema of its own options.
    pub options: fn() -> Schema,
    /// The schema of its report.
    pub report: fn() -> Schema,
    answer: fn(&Subject<'_>, Value, &Progress) -> Result<Box<dyn Report>, Error>,
}

impl AnyAnalysis {
    /// The analysis of a report.
    pub const fn of<A: Analysis>() -> Self {
        Self {
            name: A::NAME,
            title: A::TITLE,
            about: A::ABOUT,
            details: A::DETAILS,
            example: A::EXAMPLE,
            doing: A::DOING,
            scenes: A::SCENES,
            options: schema::of::<A::Options>,
            report: schema::of::<A>,
            answer: answer::<A>,
        }
    }

    /// The analysis of this name.
    pub fn named(name: &str) -> Option<&'static Self> {
        ANALYSES.iter().find(|analysis| analysis.name == name)
    }

    /// The scenes that `options` ask for.
    ///
    /// # Errors
    /// As [`LossOptions::question`].
    pub fn request(&self, options: &LossOptions) -> Result<Request, CoreError> {
        match self.scenes.contains(&SceneOptions::Sampled) {
            true => options.listed(),
            false => options.question().map(|question| question.request),
        }
    }

    /// The answer, with `options` as a JSON object; those that it lacks have their defaults.
    ///
    /// # Errors
    /// As [`Analysis::run`]; [`FilesError::Internal`] for options that are none.
    pub fn run(
        &self,
        subject: &Subject<'_>,
        options: Value,
        progress: &Progress,
    ) -> Result<Box<dyn Report>, Error> {
        (self.answer)(subject, options, progress)
    }
}

fn answer<A: Analysis>(
    subject: &Subject<'_>,
    options: Value,
    progress: &Progress,
) -> Result<Box<dyn Report>, Error> {
    let options =
        serde_json::from_value(options).map_err(|problem| FilesError::Internal(problem.to_string()))?;
    Ok(Box::new(A::run(subject, &options, progress)?))
}
