//! An analysis: a report, and the declaration that its command, its function in Python, its JSON Schema and its table in the window follow
//! from.

use serde::de::DeserializeOwned;

use svbrdf_core::error::Error as CoreError;
use svbrdf_core::loss::{Comparison, Compute, Request, check_same_size};
use svbrdf_core::material::{Mask, Material};
use svbrdf_core::math::real::Real;
use svbrdf_core::model::convention::Convention;
use svbrdf_core::progress::Progress;
use svbrdf_files::Error as FilesError;

use super::Report;
use super::heading::Compared;
use crate::diagnose::Storage;
use crate::error::Error;

/// A comparison of predictions with their ground truth.
#[derive(Clone, Debug)]
pub struct AnalysisInput<'a, T: Real = f32> {
    pub ground_truth: &'a Material<T>,
    pub predictions: Vec<&'a Material<T>>,
    /// How each is stored, the ground truth first.
    pub storages: Vec<&'a Storage>,
    /// Where each was read from, the ground truth first.
    pub paths: Vec<Option<String>>,
    pub convention: Convention,
    /// Its scenes.
    pub request: Request,
    /// Whether nothing else was asked for: the loss over the few scenes of the papers stands beside the answer.
    pub few_scenes: bool,
    /// Which texels are compared, where not all are: for losses, maps and metrics.
    pub mask: Option<Mask>,
}

impl<T: Real> AnalysisInput<'_, T> {
    /// The settings of a report.
    pub fn compared(&self) -> Compared {
        let masked = self.mask.as_ref().map(|mask| mask.texels().len());
        Compared { masked, ..Compared::new(self.ground_truth, &self.convention) }
    }

    /// What `of` computes for each prediction.
    ///
    /// # Errors
    /// Its first.
    pub fn each<R>(&self, of: impl Fn(&Material<T>) -> Result<R, Error>) -> Result<Vec<R>, Error> {
        self.predictions.iter().map(|prediction| of(prediction)).collect()
    }

    /// Names the sampled scenes; 0 for listed ones.
    pub fn seed(&self) -> u64 {
        self.request.seed().unwrap_or(0)
    }
}

impl<T: Compute> AnalysisInput<'_, T> {
    /// What `of` makes of the comparison of the materials, over the texels of the mask.
    ///
    /// # Errors
    /// Those of [`Comparison::new`] and its own.
    pub fn comparing<R>(&self, of: impl FnOnce(Comparison<'_, T>) -> Result<R, Error>) -> Result<R, Error> {
        comparing(self.ground_truth, &self.predictions, self.convention, self.mask.as_ref(), of)
    }
}

/// What `of` makes of a comparison over the texels of a mask.
///
/// # Errors
/// Those of [`Comparison::new`] and of `of`.
pub fn comparing<T: Compute, R, E: From<CoreError>>(
    truth: &Material<T>,
    predictions: &[&Material<T>],
    convention: Convention,
    mask: Option<&Mask>,
    of: impl FnOnce(Comparison<'_, T>) -> Result<R, E>,
) -> Result<R, E> {
    let Some(mask) = mask else { return of(Comparison::new(truth, predictions, convention)?) };
    predictions.iter().try_for_each(|prediction| check_same_size(truth, prediction))?;
    let texels = mask.texels();
    let kept = |one: &&Material<T>| one.gathered(&texels, [texels.len(), 1]);
    let (kept_truth, predictions): (_, Vec<_>) = (kept(&truth), predictions.iter().map(kept).collect());
    let comparison = Comparison::new(&kept_truth, &predictions.iter().collect::<Vec<_>>(), convention)?;
    of(comparison.at(truth.grid(), &texels))
}

/// An analysis of predictions: the report that it gives, and what it is called.
pub trait Analysis: Report + Schematic + Sized + 'static {
    /// Of its command, its function and its schema.
    const NAME: &'static str;
    /// What it answers, in the list of commands.
    const ANSWERS: &'static str;
    /// The group of its command.
    const GROUP: &'static str = "Explain";
    /// Arguments of its command, as examples.
    const EXAMPLES: &'static [&'static str] = &["gt.png a.png"];
    /// The title of its table in the window; without one it has none, or a section of its own.
    const TITLE: &'static str = "";
    /// What it does: one line.
    const ABOUT: &'static str;
    /// What its numbers mean.
    const DETAILS: &'static str;
    /// A call in Python with its result.
    const EXAMPLE: &'static str = "";
    /// What it does while it runs.
    const DOING: &'static str;
    /// The fields of [`LossOptions`](svbrdf_core::loss::LossOptions) that are its options, and `precision` where it has
    /// [`Analysis::run_double`]. `scenes` are those of a list.
    const SCENES: &'static [&'static str];
    /// What the command line says of some of them in place of what it says everywhere.
    const SCENES_HELP: &'static [(&'static str, &'static str)] = &[];
    /// Whether its results are pictures: [`Report::pictures`].
    const PICTURES: bool = false;
    /// Whether it follows a protocol, and compares predictions of another size and the texels of a mask.
    const PAIRED: bool = false;
    /// Its own options; all have defaults.
    type Options: Default + DeserializeOwned;
    /// The same, declared.
    const OPTIONS: &'static [AnalysisOption] = &[];

    /// The answer.
    ///
    /// # Errors
    /// Where the materials cannot be compared; [`Cancelled`](Error::is_cancelled).
    fn run(input: &AnalysisInput<'_>, options: &Self::Options, progress: &Progress) -> Result<Self, Error>;

    /// The answer in f64.
    ///
    /// # Errors
    /// As [`Analysis::run`]; [`FilesError::Internal`] of an analysis without a precision.
    fn run_double(_: &AnalysisInput<'_, f64>, _: &Self::Options, _: &Progress) -> Result<Self, Error> {
        Err(FilesError::Internal(format!("{} has no precision", Self::NAME)).into())
    }
}

/// No options.
#[derive(Clone, Copy, Debug, Default, serde::Deserialize)]
pub struct NoOptions {}

/// An option of an analysis itself.
#[derive(Clone, Copy, Debug)]
pub struct AnalysisOption {
    /// The name of its field.
    pub name: &'static str,
    pub about: &'static str,
    pub value: OptionValue,
}

/// The type of an option, with its default.
#[derive(Clone, Copy, Debug)]
pub enum OptionValue {
    /// A whole number, 0 or more.
    Count(u64),
    /// On the command line in percent.
    Share(f64),
    Stops(f32),
    /// Words, of which these are offered; none by default.
    Words(fn() -> Vec<&'static str>),
}

/// The options that decide scenes, texels and precision, but for a list of scenes: a field of
/// [`LossOptions`](svbrdf_core::loss::LossOptions) or `precision`, what it is, and what counts where it is left open. Other options stand in
/// braces.
pub const SCENE_OPTIONS: [[&str; 3]; 8] = [
    [
        "target_error",
        "Samples as many scenes as this relative error of every loss needs at 95% confidence",
        "1%",
    ],
    ["near", "Number of near-field scenes", "128; with {distant} two for each distant one"],
    ["distant", "Number of distant scenes", "64; with {near} one for two near-field ones"],
    ["sampler", "Sampler of scenes: random, or sobol, which gives less error with as many scenes", "sobol"],
    ["seed", "Seed of the sampled scenes", "0"],
    [
        "texels",
        "Compares all texels, or an independent random subset of N texels per scene, which is fast on maps of any size",
        "32; with {near} or {distant} all",
    ],
    ["time_budget", "Samples as many scenes as fit into this time", ""],
    ["precision", "Floating-point precision: f32, or f64 for reference, which is many times slower", ""],
];

/// What has a JSON Schema where the feature `schema` is on: all reports.
#[cfg(feature = "schema")]
pub use schemars::JsonSchema as Schematic;
/// All reports.
#[cfg(not(feature = "schema"))]
pub trait Schematic {}
#[cfg(not(feature = "schema"))]
impl<T> Schematic for T {}
