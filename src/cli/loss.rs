//! `svbrdf loss`: the rendering loss (Algorithm 1).

use std::time::Duration;

use svbrdf_core::loss::{Comparison, Compute, LossOptions, Precision, Question, Texels};
use svbrdf_evaluate::report::{LossReport, Report as _};

use super::args::scenes::SceneArgs;
use super::args::values::{duration, percent};
use super::args::{ComparisonArgs, Given, offered};
use super::job::{ComparisonJob, Job, NewJob, SessionSettings};
use super::output::{CommandError, ReportFormat, exit, warn_of, watched};

/// Prints the rendering loss of predictions against a ground truth
///
/// Ground truth and predictions are rendered in the same sampled scenes (light and view). The loss is the mean over scenes,
/// texels and RGB of |ln(R_gt + epsilon) - ln(R_pred + epsilon)|. The standard error is due to the sampling of scenes and
/// texels; it is unknown with a single scene of a kind. Without a number of scenes: the loss over all scenes to +-1%, and the loss
/// over the 6 + 3 scenes of the papers. With --near or --distant: the loss over exactly these scenes. A session has settings of
/// its own. Without GT and PRED: the built-in materials. docs/loss.md defines the loss.
#[derive(Debug, clap::Args)]
#[command(mut_arg("near", |arg| arg.help(
    "Number of near-field scenes, random and on all texels [default: as many as +-1% needs; with --distant two for each distant one]")))]
#[command(mut_arg("distant", |arg| arg.help(
    "Number of distant scenes [default: as many as +-1% needs; with --near one for two near-field ones]")))]
#[command(mut_arg("seed", |arg| arg.help("Seed of the sampled scenes [default: 0, or as in the session]")))]
#[command(mut_arg("sampler", |arg| arg.help(
    "Sampler of scenes: random, or sobol, which gives less error with as many scenes [default: sobol; with --near or --distant random]")))]
pub struct LossArgs {
    #[command(flatten)]
    scenes: SceneArgs,

    /// Compares all texels, or an independent random subset of N texels per scene, which is fast on maps of any size
    /// [default: 32; with --near or --distant all]
    #[arg(help_heading = "Scenes", long, value_name = "all|N", allow_negative_numbers = true)]
    #[arg(value_parser = offered(str::parse::<Texels>, ["all"]), hide_possible_values = true)]
    texels: Option<Texels>,

    /// Samples as many scenes as this relative error needs at 95% confidence, such as 1%
    #[arg(help_heading = "Scenes", long, value_name = "PERCENT", value_parser = percent, allow_hyphen_values = true)]
    target_error: Option<f64>,

    /// Samples as many scenes as fit into this time, such as 500ms or 2s
    #[arg(help_heading = "Scenes", long, value_name = "TIME", value_parser = duration, allow_hyphen_values = true)]
    time_budget: Option<Duration>,

    /// Floating-point precision
    #[arg(long, value_name = "f32|f64", default_value = "f32")]
    #[arg(value_parser = offered(str::parse::<Precision>, ["f32", "f64"]), hide_possible_values = true)]
    precision: Precision,

    /// Output format
    #[arg(long, value_enum, default_value_t)]
    format: ReportFormat,

    #[command(flatten)]
    comparison: ComparisonArgs,
}

/// A loss to compute.
#[derive(Debug)]
struct LossJob {
    comparison: ComparisonJob,
    question: Question,
    precision: Precision,
    format: ReportFormat,
}

impl LossArgs {
    pub fn job(self, given: &Given) -> NewJob {
        let comparison = ComparisonJob::with_predictions(&self.comparison, given)?;
        let Self { scenes, texels, target_error, time_budget, precision, format, .. } = self;
        let options = LossOptions { texels, target_error, time_budget, ..scenes.options()? };
        let question = SessionSettings::question(comparison.session.as_ref(), &options)?;
        Ok(Box::new(LossJob { comparison, question, precision, format }))
    }
}

/// Prints the losses to stdout; with `--strict` fails where a target error is not reached, after the losses are printed.
impl Job for LossJob {
    fn run(self: Box<Self>) -> Result<(), CommandError> {
        let report = match self.precision {
            Precision::F32 => self.report::<f32>()?,
            Precision::F64 => self.report::<f64>()?,
        };
        let materials = self.comparison.materials;
        let paths = materials.paths.iter().map(|path| Some(path.display().to_string())).collect();
        let report = report.read_from(paths);
        exit::put(&self.format.write(&report)?)?;
        warn_of(report.missed(), materials.strict)
    }
}

impl LossJob {
    /// Opens the materials in precision `T` and answers the question.
    fn report<T: Compute>(&self) -> Result<LossReport, CommandError> {
        let opened = self.comparison.materials.open::<T>()?;
        let predictions: Vec<_> = opened.predictions.iter().collect();
        let comparison = Comparison::new(&opened.ground_truth, &predictions, self.comparison.convention)?;
        Ok(watched("rendering", |progress| LossReport::answer(&comparison, &self.question, progress))?)
    }
}
