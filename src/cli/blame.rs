//! `svbrdf blame`: how much of a loss comes from each map.

use std::path::PathBuf;

use svbrdf_core::loss::Request;
use svbrdf_core::material::Material;
use svbrdf_evaluate::report::{BlameReport, Compared, Report as _};
use svbrdf_evaluate::why::attribute;
use svbrdf_files::scene_file;

use super::args::lights::LightsArgs;
use super::args::{ComparisonArgs, Given, SeedArgs, values};
use super::job::ComparisonJob;
use super::output::report::ReportFormat;
use super::output::{CommandError, exit, target, watched};

/// Prints how much of the rendering loss comes from each map
///
/// Renders all 16 mixtures of the maps of the ground truth and of the prediction in the same scenes on the same texels. The Shapley
/// value of a map is the mean of what it adds to the loss over all orders in which the maps can become wrong; the four
/// values add up to the loss. Beside them stands the loss where only this map is wrong, and where only this map is right. A share
/// below 0%: the error of this map hides errors of others. Without GT and PRED: the built-in materials.
#[derive(Debug, clap::Args)]
#[command(after_help = "Example:\n  svbrdf blame gt.png a.png")]
pub struct BlameArgs {
    /// Samples as many scenes as this relative error of the loss needs at 95% confidence, at most 49,152
    #[arg(help_heading = "Scenes", long, value_name = "PERCENT", value_parser = values::percent, allow_hyphen_values = true, default_value = "1%")]
    target_error: f64,

    #[command(flatten)]
    seed: SeedArgs,

    /// Uses the scenes of a JSON file instead of sampled ones, or those of a MaterialGAN capture (render.json)
    #[arg(help_heading = "Scenes", long, value_name = "FILE", conflicts_with_all = ["target_error", "seed", "lights", "fov"])]
    scenes: Option<PathBuf>,

    #[command(flatten)]
    lights: LightsArgs,

    /// Output format
    #[arg(long, value_enum, default_value_t)]
    format: ReportFormat,

    #[command(flatten)]
    comparison: ComparisonArgs,
}

/// Prints the attributions to stdout.
///
/// # Errors
/// Where a material or the scenes cannot be read or used; with `--strict` where the target error is not reached, after the results
/// are printed.
pub fn run(args: &BlameArgs, given: &Given) -> Result<(), CommandError> {
    let job = ComparisonJob::new(&args.comparison, given)?;
    job.materials.check_predictions()?;
    let request = match (&args.scenes, args.lights.scenes(given)?) {
        (_, Some(scenes)) => Request::Listed(scenes),
        (Some(path), None) => Request::Listed(scene_file::read(path)?),
        (None, None) => Request::Accuracy { target: args.target_error, seed: args.seed.seed },
    };
    let opened = job.materials.open::<f32>()?;
    let one = |prediction: &Material<f32>| {
        watched("rendering", |progress| {
            attribute(&opened.ground_truth, prediction, &job.convention, &request, progress)
        })
    };
    let attributions = opened.predictions.iter().map(one).collect::<Result<Vec<_>, _>>()?;
    let compared = Compared::new(&opened.ground_truth, &job.convention);
    let report = BlameReport::new(compared, &request, attributions);
    exit::put(&args.format.write(&report)?)?;
    target::warn_of(report.missed(), job.materials.strict)
}
