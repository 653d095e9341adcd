//! `svbrdf loss`: the rendering loss (Algorithm 1).

use std::path::PathBuf;
use std::time::Duration;

use svbrdf::backend::{self, Adapter};
use svbrdf_core::error::Error;
use svbrdf_core::loss::{Comparison, Compute, Precision, Question, Request, Sampling, SceneChoice, Texels};
use svbrdf_core::model::sampler::Sampler;
use svbrdf_evaluate::report::{LossReport, Report as _};
use svbrdf_files::scene_file;

use super::args::lights::LightsArgs;
use super::args::values::{duration, percent, whole};
use super::args::{ComparisonArgs, Given, modes};
use super::job::{ComparisonJob, SessionSettings};
use super::output::report::ReportFormat;
use super::output::{CommandError, exit, target, watched};

/// Prints the rendering loss of predictions against a ground truth
///
/// Ground truth and predictions are rendered in the same sampled scenes (light and view). The loss is the mean over scenes,
/// texels and RGB of |ln(R_gt + epsilon) - ln(R_pred + epsilon)|. The standard error is due to the sampling of scenes and
/// texels; it is unknown with a single scene of a kind. Without a number of scenes: the loss over all
/// scenes to +-1%, in Sobol scenes with 32 random texels each, and the loss over the 6 + 3 scenes of the papers; of a session, what
/// its window asked for. With --near or --distant: the loss over exactly these scenes. A folder of training
/// steps, such as NAME_step000100.png or epoch_12/, stands for all its steps. Without GT and PRED: the built-in materials.
#[derive(Debug, clap::Args)]
#[command(after_help = "Example:\n  svbrdf loss gt.png a.png b.png --target-error 0.5%")]
pub struct LossArgs {
    /// Number of near-field scenes, random and on all texels [default: as many as +-1% needs; with --distant two for each distant one]
    #[arg(help_heading = "Scenes", long, value_name = "N", value_parser = whole::<usize>, allow_negative_numbers = true)]
    near: Option<usize>,

    /// Number of distant scenes [default: as many as +-1% needs; with --near one for two near-field ones]
    #[arg(help_heading = "Scenes", long, value_name = "N", value_parser = whole::<usize>, allow_negative_numbers = true)]
    distant: Option<usize>,

    /// Seed of the sampled scenes [default: 0, or as in the session]
    #[arg(help_heading = "Scenes", long, value_name = "N", value_parser = whole::<u64>, allow_negative_numbers = true)]
    seed: Option<u64>,

    /// Sampler of scenes: random, or sobol, which gives less error with as many scenes [default: sobol; with --near or --distant
    /// random]
    #[arg(help_heading = "Scenes", long, value_name = "random|sobol")]
    sampler: Option<Sampler>,

    /// Compares all texels, or an independent random subset of N texels per scene, which is fast on maps of any size
    /// [default: 128; with --near or --distant all]
    #[arg(
        help_heading = "Scenes",
        long,
        value_name = "all|N",
        allow_negative_numbers = true,
        conflicts_with = "scenes"
    )]
    texels: Option<Texels>,

    /// Samples as many scenes as this relative error needs at 95% confidence, such as 1%
    #[arg(help_heading = "Scenes", long, value_name = "PERCENT", value_parser = percent, allow_hyphen_values = true,
        conflicts_with_all = ["near", "distant", "sampler", "texels", "scenes", "time_budget"])]
    target_error: Option<f64>,

    /// Samples as many scenes as fit into this time, such as 500ms or 2s
    #[arg(help_heading = "Scenes", long, value_name = "TIME", value_parser = duration, allow_hyphen_values = true,
        conflicts_with_all = ["near", "distant", "sampler", "texels", "scenes"])]
    time_budget: Option<Duration>,

    /// Uses the scenes of a JSON file instead of sampled ones, or those of a MaterialGAN capture (render.json)
    #[arg(help_heading = "Scenes", long, value_name = "FILE", conflicts_with_all = ["near", "distant", "seed", "sampler", "lights", "fov"])]
    scenes: Option<PathBuf>,

    #[command(flatten)]
    lights: LightsArgs,

    /// Floating-point precision
    #[arg(long, value_name = "f32|f64", default_value = "f32")]
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

/// A loss to compute: the arguments, resolved.
struct LossJob {
    comparison: ComparisonJob,
    question: Question,
    device: DeviceChoice,
}

/// Prints the losses to stdout.
///
/// # Errors
/// Where a material or the scenes cannot be read or used; with `--strict` where a target error is not reached, after the
/// losses are printed.
pub fn run(mut args: LossArgs, given: &Given) -> Result<(), CommandError> {
    let steps = args.comparison.materials.expand_steps()?;
    if (args.precision, args.backend) == (Precision::F64, DeviceChoice::Auto) {
        exit::tell("note: computed on the CPU: graphics adapters compute in f32");
    }
    let job = LossJob::new(&args, given)?;
    let report = match args.precision {
        Precision::F32 => job.report(|comparison, request| job.run(comparison, request))?,
        Precision::F64 => job.report(on_backend::<f64>)?,
    };
    let materials = job.comparison.materials;
    let paths = materials.paths.iter().map(|path| Some(path.display().to_string())).collect();
    let report = report.read_from(paths, steps);
    exit::put(&args.format.write(&report)?)?;
    target::warn_of(report.missed(), materials.strict)
}

impl LossJob {
    fn new(args: &LossArgs, given: &Given) -> Result<Self, CommandError> {
        let comparison = ComparisonJob::new(&args.comparison, given)?;
        comparison.materials.check_predictions()?;
        let question = match (args.lights.scenes(given)?, request(args)?) {
            (Some(scenes), _) => Request::Listed(scenes).into(),
            (None, Some(request)) => request.into(),
            (None, None) => sampled(args, comparison.session.as_ref(), given)?,
        };
        check_backend(args, &question)?;
        Ok(Self { comparison, question, device: args.backend })
    }

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
    fn run(&self, comparison: Comparison<'_, f32>, request: &Request) -> Result<LossReport, Error> {
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

/// The question where neither an accuracy, a time nor a file decides the scenes: that of the session, unless options choose scenes.
fn sampled(
    args: &LossArgs,
    session: Option<&SessionSettings>,
    given: &Given,
) -> Result<Question, CommandError> {
    let LossArgs { near, distant, sampler, texels, .. } = *args;
    let choice = SceneChoice { near, distant, sampler, texels };
    let question = match session.and_then(|session| session.request(args.seed)) {
        None => choice.question(args.seed.unwrap_or(0)),
        Some(saved) if choice == SceneChoice::default() => {
            if let Request::Listed(_) = saved {
                given.check(&modes::SESSION_SCENES)?;
            }
            Ok(saved.into())
        }
        Some(saved) => choice.over(saved),
    };
    Ok(question?)
}

/// A graphics adapter compares all texels, in f32.
fn check_backend(args: &LossArgs, question: &Question) -> Result<(), CommandError> {
    let few_scenes = question.few_scenes.map(Request::Scenes);
    let problem = match (args.backend, args.precision, few_scenes.as_ref().unwrap_or(&question.request)) {
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

/// The request where an accuracy, a time or a file decides the scenes.
fn request(args: &LossArgs) -> Result<Option<Request>, Error> {
    let seed = args.seed.unwrap_or(0);
    Ok(match (args.target_error, args.time_budget, &args.scenes) {
        (Some(target), ..) => Some(Request::Accuracy { target, seed }),
        (None, Some(budget), _) => Some(Request::Time { budget, seed }),
        (None, None, Some(path)) => Some(Request::Listed(scene_file::read(path)?)),
        (None, None, None) => None,
    })
}
