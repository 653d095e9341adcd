//! `svbrdf scenes`: the scenes with the largest losses.

use svbrdf_core::loss::Comparison;
use svbrdf_evaluate::report::{Compared, ScenesReport};

use super::args::scenes::SceneArgs;
use super::args::values::whole;
use super::args::{ComparisonArgs, Given};
use super::job::ComparisonJob;
use super::output::report::ReportFormat;
use super::output::{CommandError, exit, watched};

/// Prints the scenes with the largest losses, worst first
///
/// Scenes are sorted by the mean of the losses of all predictions in them, over all texels. The JSON is a scene file that
/// `--scenes` takes. Without GT and PRED: the built-in materials.
#[derive(Debug, clap::Args)]
#[command(after_help = "Example:\n  svbrdf scenes gt.png a.png --top 5 --format json > worst.json")]
pub struct ScenesArgs {
    /// Number of scenes that are printed
    #[arg(long, value_name = "N", value_parser = whole::<usize>, allow_negative_numbers = true, default_value_t = 10)]
    top: usize,

    #[command(flatten)]
    scenes: SceneArgs,

    /// Output format
    #[arg(long, value_enum, default_value_t)]
    format: ReportFormat,

    #[command(flatten)]
    comparison: ComparisonArgs,
}

/// Prints the scenes to stdout.
///
/// # Errors
/// Where a material or the scenes cannot be read or used.
pub fn run(args: &ScenesArgs, given: &Given) -> Result<(), CommandError> {
    let job = ComparisonJob::new(&args.comparison, given)?;
    job.materials.check_predictions()?;
    let request = args.scenes.request(given)?;
    let opened = job.materials.open::<f32>()?;
    let predictions: Vec<_> = opened.predictions.iter().collect();
    let comparison = Comparison::new(&opened.ground_truth, &predictions, job.convention)?.without_pilot();
    let outcome = watched("rendering", |progress| comparison.run(&request, progress))?;
    let compared = Compared::new(&opened.ground_truth, &job.convention);
    Ok(exit::put(&args.format.write(&ScenesReport::new(compared, &outcome, args.top))?)?)
}
