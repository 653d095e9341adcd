//! All analyses, each declared beside its report: what has a command, a function of Python and a table in the window.

use serde_json::Value;

use svbrdf_core::error::Error as CoreError;
use svbrdf_core::loss::{LossOptions, Request};
use svbrdf_core::progress::Progress;
use svbrdf_files::Error as FilesError;

use crate::error::Error;
use crate::report::{
    Analysis, AnalysisInput, AnalysisOption, BlameReport, MetricsReport, Report, SceneOptions, ScenesReport,
    WorstReport,
};

/// All of them, in the order of the commands.
pub const ANALYSES: [AnyAnalysis; 4] = [
    AnyAnalysis::of::<BlameReport>(),
    AnyAnalysis::of::<ScenesReport>(),
    AnyAnalysis::of::<WorstReport>(),
    AnyAnalysis::of::<MetricsReport>(),
];

/// Runs an analysis with its own options as a JSON object.
type Answer = fn(&AnalysisInput<'_>, Value, &Progress) -> Result<Box<dyn Report>, Error>;

/// One of the [`ANALYSES`].
#[derive(Clone, Copy, Debug)]
pub struct AnyAnalysis {
    pub name: &'static str,
    pub title: &'static str,
    pub about: &'static str,
    pub details: &'static str,
    pub doing: &'static str,
    pub scenes: &'static [SceneOptions],
    /// Its own options.
    pub options: &'static [AnalysisOption],
    /// The schemas of its options and of its report.
    #[cfg(feature = "schema")]
    pub schemas: [fn() -> schemars::Schema; 2],
    answer: Answer,
}

impl AnyAnalysis {
    /// The analysis of a report.
    pub const fn of<A: Analysis>() -> Self {
        Self {
            name: A::NAME,
            title: A::TITLE,
            about: A::ABOUT,
            details: A::DETAILS,
            doing: A::DOING,
            scenes: A::SCENES,
            options: A::OPTIONS,
            #[cfg(feature = "schema")]
            schemas: [crate::json_schema::schema_of::<A::Options>, crate::json_schema::schema_of::<A>],
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
        input: &AnalysisInput<'_>,
        options: Value,
        progress: &Progress,
    ) -> Result<Box<dyn Report>, Error> {
        (self.answer)(input, options, progress)
    }
}

fn answer<A: Analysis>(
    input: &AnalysisInput<'_>,
    options: Value,
    progress: &Progress,
) -> Result<Box<dyn Report>, Error> {
    let options =
        serde_json::from_value(options).map_err(|problem| FilesError::Internal(problem.to_string()))?;
    Ok(Box::new(A::run(input, &options, progress)?))
}
