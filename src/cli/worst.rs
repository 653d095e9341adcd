//! `svbrdf worst`: the scene with the largest loss.

use svbrdf_core::material::Material;
use svbrdf_core::report::{Compared, Report as _, WorstReport};
use svbrdf_core::why::worst;

use super::args::{ComparisonArgs, Given};
use super::job::ComparisonJob;
use super::output::report::ReportFormat;
use super::output::{CommandError, exit, target, watched};

/// Searches for the scene with the largest loss of each prediction
///
/// Samples 6,144 of the scenes that the loss is over, then refines the 16 worst. The search compares up to 1,024 texels; the
/// printed loss is over all. The mean is the loss over all scenes, to +-1% where 49,152 scenes are enough. The JSON is a scene file
/// that `--scenes` takes. Without GT and PRED: the built-in materials.
#[derive(Debug, clap::Args)]
#[command(after_help = "Example:\n  svbrdf worst gt.png a.png")]
pub struct WorstArgs {
    /// Seed of the scenes that the search starts from
    #[arg(
        help_heading = "Scenes",
        long,
        value_name = "N",
        allow_negative_numbers = true,
        default_value_t = 0
    )]
    seed: u64,

    /// Output format
    #[arg(long, value_enum, default_value_t)]
    format: ReportFormat,

    #[command(flatten)]
    comparison: ComparisonArgs,
}

/// Prints the worst scenes to stdout.
///
/// # Errors
/// Where a material cannot be read or used; with `--strict` where a mean is known less well, after the results are printed.
pub fn run(args: &WorstArgs, given: &Given) -> Result<(), CommandError> {
    let job = ComparisonJob::new(&args.comparison, given)?;
    job.materials.check_predictions()?;
    let opened = job.materials.open::<f32>()?;
    let one = |prediction: &Material<f32>| {
        watched("searching", |progress| {
            worst(&opened.ground_truth, prediction, &job.convention, args.seed, progress)
        })
    };
    let found = opened.predictions.iter().map(one).collect::<Result<Vec<_>, _>>()?;
    let compared = Compared::new(&opened.ground_truth, &job.convention);
    let report = WorstReport { compared, found };
    exit::put(&args.format.write(&report)?)?;
    target::warn_of(report.missed(), job.materials.strict)
}
