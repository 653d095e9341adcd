//! All analyses, each declared beside its report: what has a command, a function of Python and a table in the window.

mod blame;
mod diagnose;
mod kept;
mod loss;
mod loss_table;
mod map;
mod metrics;
mod rank;
mod scenes;
mod worst;

pub use blame::BlameReport;
pub use diagnose::DiagnoseReport;
pub use loss::{LossReport, SampledScenes};
pub use map::MapReport;
pub use metrics::MetricsReport;
pub use rank::{MaterialReading, RankReport};
pub use scenes::ScenesReport;
pub use worst::WorstReport;

use serde::de::DeserializeOwned;
use serde_json::{Map, Value};

use svbrdf_core::error::Error as CoreError;
use svbrdf_core::loss::{Compute, LossOptions, LossSettings, Request};
use svbrdf_core::progress::Progress;
use svbrdf_core::text::of_json;

use crate::error::Error;
use crate::report::{Analysis, AnalysisInput, AnalysisOption, Report};

/// All of them, in the order of the commands.
pub const ANALYSES: &[AnyAnalysis] = &[
    AnyAnalysis::of::<LossReport>(),
    AnyAnalysis::of::<RankReport>(),
    AnyAnalysis::of::<MetricsReport>(),
    AnyAnalysis::of::<BlameReport>(),
    AnyAnalysis::of::<DiagnoseReport>(),
    AnyAnalysis::of::<ScenesReport>(),
    AnyAnalysis::of::<WorstReport>(),
    AnyAnalysis::of::<MapReport>(),
];

/// Runs an analysis with its own options as a JSON object.
pub type RunAnalysis<T> = fn(&AnalysisInput<'_, T>, Value, &Progress) -> Result<Box<dyn Report>, Error>;

/// One of the [`ANALYSES`].
#[derive(Clone, Copy, Debug)]
pub struct AnyAnalysis {
    pub name: &'static str,
    pub answers: &'static str,
    pub group: &'static str,
    pub examples: &'static [&'static str],
    /// Of its table in the window; empty where it has none.
    pub title: &'static str,
    pub about: &'static str,
    pub details: &'static str,
    pub example: &'static str,
    pub doing: &'static str,
    /// Those of its options that decide scenes or precision.
    pub scenes: &'static [&'static str],
    pub scenes_help: &'static [(&'static str, &'static str)],
    /// Whether its results are pictures.
    pub pictures: bool,
    /// Whether it follows a protocol, and compares predictions of another size and the texels of a mask.
    pub paired: bool,
    /// Its own options.
    pub options: &'static [AnalysisOption],
    /// The schema of its report.
    #[cfg(feature = "schema")]
    pub schema: fn() -> schemars::Schema,
    run_single: RunAnalysis<f32>,
    run_double: RunAnalysis<f64>,
}

/// A precision that analyses are run in.
pub trait Precise: Compute {
    /// What runs `analysis` in it.
    fn runs(analysis: &AnyAnalysis) -> RunAnalysis<Self>;
}

impl Precise for f32 {
    fn runs(analysis: &AnyAnalysis) -> RunAnalysis<Self> {
        analysis.run_single
    }
}

impl Precise for f64 {
    fn runs(analysis: &AnyAnalysis) -> RunAnalysis<Self> {
        analysis.run_double
    }
}

impl AnyAnalysis {
    /// The analysis of a report.
    pub const fn of<A: Analysis>() -> Self {
        Self {
            name: A::NAME,
            answers: A::ANSWERS,
            group: A::GROUP,
            examples: A::EXAMPLES,
            title: A::TITLE,
            about: A::ABOUT,
            details: A::DETAILS,
            example: A::EXAMPLE,
            doing: A::DOING,
            scenes: A::SCENES,
            scenes_help: A::SCENES_HELP,
            pictures: A::PICTURES,
            paired: A::PAIRED,
            options: A::OPTIONS,
            #[cfg(feature = "schema")]
            schema: crate::json_schema::schema_of::<A>,
            run_single: |input, options, progress| {
                Ok(Box::new(A::run(input, &options_of(options)?, progress)?))
            },
            run_double: |input, options, progress| {
                Ok(Box::new(A::run_double(input, &options_of(options)?, progress)?))
            },
        }
    }

    /// The analysis of this name.
    pub fn named(name: &str) -> Option<&'static Self> {
        ANALYSES.iter().find(|analysis| analysis.name == name)
    }

    /// Whether it samples scenes one by one where nothing decides their number.
    pub fn lists_scenes(&self) -> bool {
        self.scenes.contains(&"near") && !self.scenes.contains(&"target_error")
    }

    /// Whether settings of the loss in a session stand for options that are left open: where both a number of scenes and an accuracy can
    /// be asked for.
    pub fn takes_settings(&self) -> bool {
        ["near", "target_error"].iter().all(|option| self.scenes.contains(option))
    }

    /// What `options` ask for, where a session has `saved` settings over these.
    ///
    /// # Errors
    /// As [`LossOptions::request`].
    pub fn request(&self, options: &LossOptions, saved: Option<&LossSettings>) -> Result<Request, CoreError> {
        match saved.filter(|_| self.takes_settings()) {
            Some(saved) => options.over(saved),
            None if self.lists_scenes() => options.listed(),
            None => options.request(),
        }
    }

    /// The answer, with `options` as a JSON object; those that it lacks have their defaults.
    ///
    /// # Errors
    /// As [`Analysis::run`] and [`options_of`].
    pub fn run<T: Precise>(
        &self,
        input: &AnalysisInput<'_, T>,
        options: Value,
        progress: &Progress,
    ) -> Result<Box<dyn Report>, Error> {
        T::runs(self)(input, options, progress)
    }
}

/// Options, which all have defaults, of a JSON object.
///
/// # Errors
/// [`Error::BadOption`].
pub fn options_of<O: DeserializeOwned>(given: Value) -> Result<O, Error> {
    let bad = |name: &str| {
        let name = name.to_owned();
        move |problem: serde_json::Error| Error::BadOption { name, problem: of_json(&problem) }
    };
    for (name, value) in given.as_object().into_iter().flatten() {
        let alone = Map::from_iter([(name.clone(), value.clone())]);
        serde_json::from_value::<O>(alone.into()).map_err(bad(name))?;
    }
    serde_json::from_value(given).map_err(bad("question"))
}
