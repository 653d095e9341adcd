//! `svbrdf loss`: the rendering loss (Algorithm 1).

use std::time::Duration;

use svbrdf::backend::{self, Adapter};
use svbrdf_core::error::Error;
use svbrdf_core::loss::{Comparison, Compute, LossOptions, Precision, Question, Request, Sampling, Texels};
use svbrdf_evaluate::report::{LossReport, Report as _};

use super::args::scenes::SceneArgs;
use super::args::values::{duration, percent};
use super::args::{ComparisonArgs, Given, offered};
use super::job::{ComparisonJob, Job, NewJob, SessionSettings};
use super::output::report::ReportFormat;
use super::output::{CommandError, exit, target, watched};

/// Prints the rendering loss of predictions against a ground truth
///
/// Ground truth and predictions are rendered in the same sampled scenes (light and view). The loss is the mean over scenes,
/// texels and RGB of |ln(R_gt + epsilon) - ln(R_pred + epsilon)|. The standard error is due to the sampling of scenes and
/// texels; it is unknown with a single scene of a kind. Without a number of scenes: the loss over all scenes to +-1%, and the loss
/// over the 6 + 3 scenes of the papers. With --near or --distant: the loss over exactly these scenes. A session has settings of
/// its own. A folder of training steps, such as NAME_step000100.png or epoch_12/, stands for all its steps. Without GT and PRED: the
/// built-in materials. docs/loss.md defines the loss.
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

    /// Device that computes the loss
    #[arg(long, value_enum, default_value_t)]
    backend: DeviceChoice,

    /// Output format
    #[arg(long, value_enum, default_value_t)]
    format: ReportFormat,

    #[command(flatten)]
    comparison: ComparisonArgs,
}

/// The requested device.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, clap::ValueEnum)]
enum DeviceChoice {
    /// The CPU, which the window uses, too
    #[default]
    Cpu,
    /// The graphics adapter: equal to about 6 digits; faster for many scenes and large maps on a fast adapter
    Gpu,
    /// Measures both on a few scenes and uses the faster one
    Auto,
}

/// A loss to compute.
#[derive(Debug)]
struct LossJob {
    comparison: ComparisonJob,
    /// The number of the step of each prediction.
    steps: Vec<Option<u64>>,
    question: Question,
    precision: Precision,
    device: DeviceChoice,
    format: ReportFormat,
}

impl LossArgs {
    pub fn job(mut self, given: &Given) -> NewJob {
        let steps = self.comparison.materials.expand_steps()?;
        let comparison = ComparisonJob::with_predictions(&self.comparison, given)?;
        let Self { scenes, texels, target_error, time_budget, precision, backend: device, format, .. } = self;
        let options = LossOptions { texels, target_error, time_budget, ..scenes.options()? };
        let question = SessionSettings::question(comparison.session.as_ref(), &options)?;
        check_backend(device, precision, &question)?;
        Ok(Box::new(LossJob { comparison, steps, question, precision, device, format }))
    }
}

/// Prints the losses to stdout; with `--strict` fails where a target error is not reached, after the losses are printed.
impl Job for LossJob {
    fn run(self: Box<Self>) -> Result<(), CommandError> {
        if (self.precision, self.device) == (Precision::F64, DeviceChoice::Auto) {
            exit::tell("note: computed on the CPU: graphics adapters compute in f32");
        }
        let report = match self.precision {
            Precision::F32 => self.report(|comparison, request| self.on_device(comparison, request))?,
            Precision::F64 => self.report(on_backend::<f64>)?,
        };
        let materials = self.comparison.materials;
        let paths = materials.paths.iter().map(|path| Some(path.display().to_string())).collect();
        let report = report.read_from(paths, self.steps);
        exit::put(&self.format.write(&report)?)?;
        target::warn_of(report.missed(), materials.strict)
    }
}

impl LossJob {
    /// Opens the materials in precision `T` and answers the question: with `run`, but what few scenes stand beside on the CPU.
    fn report<T: Compute>(
        &self,
        run: impl FnOnce(Comparison<'_, T>, &Request) -> Result<LossReport, Error>,
    ) -> Result<LossReport, CommandError> {
        let opened = self.comparison.materials.open::<T>()?;
        let predictions: Vec<_> = opened.predictions.iter().collect();
        let comparison = Comparison::new(&opened.ground_truth, &predictions, self.comparison.convention)?;
        let Question { request, few_scenes: Some(few) } = &self.question else {
            return Ok(run(comparison, &self.question.request)?);
        };
        if self.device != DeviceChoice::Cpu {
            exit::tell(
                "note: the loss over all scenes is computed on the CPU: graphics adapters compare a fixed number of scenes",
            );
        }
        let report = on_backend(comparison.clone(), request)?;
        Ok(report.beside(run(comparison, &Request::Scenes(*few))?))
    }

    /// The report of `request`, computed on the requested device.
    fn on_device(&self, comparison: Comparison<'_, f32>, request: &Request) -> Result<LossReport, Error> {
        let adapter = match self.device {
            DeviceChoice::Cpu => None,
            DeviceChoice::Gpu => Some(Adapter::start()?),
            DeviceChoice::Auto => {
                let fastest = backend::fastest(&comparison, request)?;
                exit::tell(&format!("note: {fastest}"));
                fastest.adapter
            }
        };
        match &adapter {
            Some(adapter) => on_backend(comparison.on(adapter.backend()), request),
            None => on_backend(comparison, request),
        }
    }
}

/// The report of `request`, computed by the backend of `comparison`.
fn on_backend<T: Compute>(comparison: Comparison<'_, T>, request: &Request) -> Result<LossReport, Error> {
    let outcome = watched("rendering", |progress| comparison.run(request, progress))?;
    Ok(LossReport::new(&comparison, request, outcome))
}

/// A graphics adapter compares all texels, in f32.
fn check_backend(
    device: DeviceChoice,
    precision: Precision,
    question: &Question,
) -> Result<(), CommandError> {
    let few_scenes = question.few_scenes.map(Request::Scenes);
    let problem = match (device, precision, few_scenes.as_ref().unwrap_or(&question.request)) {
        (DeviceChoice::Cpu | DeviceChoice::Auto, ..) => return Ok(()),
        (DeviceChoice::Gpu, Precision::F64, _) => {
            "graphics adapters compute in f32; leave out --backend gpu, or --precision f64"
        }
        (
            DeviceChoice::Gpu,
            _,
            Request::Listed(_) | Request::Scenes(Sampling { texels: Texels::All, .. }),
        ) => {
            return Ok(());
        }
        _ => {
            "graphics adapters compare all texels; leave out --backend gpu, or \
            --texels, --target-error and --time-budget"
        }
    };
    Err(CommandError::usage(problem))
}
