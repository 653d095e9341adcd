//! `svbrdf loss`: Algorithm 1.

use std::path::PathBuf;

use svbrdf::convention::Convention;
use svbrdf::error::Error;
use svbrdf::loss::{Loss, LossParams, Precision, losses};
use svbrdf::real::Real;
use svbrdf::scene::{self, Scene};

use super::backend::{self, Choice, Job};
use super::bar::watched;
use super::report::{Format, Report};
use super::{exit, materials};

/// Prints the rendering loss of predictions against a ground truth
///
/// Both are rendered under the same random lights and views; the loss is the mean over scenes, texels and RGB
/// of |ln(R_gt + epsilon) - ln(R_pred + epsilon)|. The standard error is that of the choice of scenes; it is
/// unknown where only one scene of a kind is drawn. Without GT and PRED: the built-in materials.
#[derive(Debug, clap::Args)]
pub struct LossArgs {
    /// Number of near-field scenes
    #[arg(long, value_name = "N", allow_negative_numbers = true, default_value_t = 6)]
    near: usize,

    /// Number of distant scenes
    #[arg(long, value_name = "N", allow_negative_numbers = true, default_value_t = 3)]
    distant: usize,

    /// Names the scenes that are drawn
    #[arg(long, value_name = "N", allow_negative_numbers = true, default_value_t = 0)]
    seed: u64,

    /// printed, single-image-2018, multi-image-2019 or guided-2020
    #[arg(long, value_name = "NAME", default_value = "printed")]
    convention: Convention,

    /// Uses the scenes of this JSON file instead of drawn ones
    #[arg(long, value_name = "FILE", conflicts_with_all = ["near", "distant", "seed"])]
    scenes: Option<PathBuf>,

    /// What is computed in
    #[arg(long, value_name = "f32|f64", default_value = "f32")]
    precision: Precision,

    /// What computes it
    #[arg(long, value_enum, default_value_t)]
    backend: Choice,

    /// What is printed: text for people, json or csv for programs
    #[arg(long, value_enum, default_value_t)]
    format: Format,

    #[command(flatten)]
    materials: materials::MaterialArgs,
}

/// Prints the losses to stdout.
///
/// # Errors
/// Where a material or the scenes cannot be read or used.
pub fn run(args: &LossArgs) -> Result<(), Error> {
    check_predictions(&args.materials)?;
    let report = match (args.precision, args.backend) {
        (Precision::F32, backend) => report(args, |job, scenes| backend::losses(backend, job, scenes))?,
        (Precision::F64, Choice::Gpu) => {
            let problem = "graphics adapters compute in f32; leave out --backend gpu, or --precision f64";
            return Err(Error::Usage(problem.to_owned()));
        }
        (Precision::F64, Choice::Cpu | Choice::Auto) => report(args, in_f64)?,
    };
    exit::put(&report.to_text(args.format).map_err(exit::unwritable)?)
}

/// The plain loss, which the CPU alone can compute.
fn in_f64(job: &Job<'_, f64>, scenes: &[Scene]) -> Result<(Vec<Loss>, &'static str), Error> {
    let Job { ground_truth, predictions, convention } = *job;
    let losses = watched("rendering", |p| losses(ground_truth, predictions, scenes, convention, p))?;
    Ok((losses, "cpu"))
}

/// Opens what is compared and computes it with `losses`, which also says on what.
fn report<T: Real>(
    args: &LossArgs,
    losses: impl FnOnce(&Job<'_, T>, &[Scene]) -> Result<(Vec<Loss>, &'static str), Error>,
) -> Result<Report, Error> {
    let scenes = scenes(args)?;
    let opened = materials::open::<T>(&args.materials)?;
    let predictions: Vec<_> = opened.predictions.iter().collect();
    let job =
        Job { ground_truth: &opened.ground_truth, predictions: &predictions, convention: &args.convention };
    let (losses, backend) = losses(&job, &scenes)?;
    Ok(Report {
        convention: args.convention,
        ground_truth: opened.ground_truth.name().to_owned(),
        size: opened.ground_truth.size(),
        seed: args.scenes.is_none().then_some(args.seed),
        precision: T::NAME,
        backend,
        scenes,
        losses,
    })
}

fn check_predictions(materials: &materials::MaterialArgs) -> Result<(), Error> {
    match &materials.ground_truth {
        Some(path) if materials.predictions.is_empty() => Err(Error::Usage(format!(
            "there is no prediction to compare with {}; give one or more after it",
            path.display()
        ))),
        _ => Ok(()),
    }
}

fn scenes(args: &LossArgs) -> Result<Vec<Scene>, Error> {
    match &args.scenes {
        Some(path) => scene::read(path),
        None => LossParams {
            near: args.near,
            distant: args.distant,
            seed: args.seed,
            convention: args.convention,
            precision: args.precision,
        }
        .scenes(),
    }
}
