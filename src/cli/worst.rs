//! `svbrdf worst`: the scene with the largest loss.

use svbrdf_core::material::Material;
use svbrdf_evaluate::report::{Compared, Report as _, WorstReport};
use svbrdf_evaluate::why::worst;

use super::args::{ComparisonArgs, Given, SeedArgs, values};
use super::job::ComparisonJob;
use super::output::report::ReportFormat;
use super::output::{CommandError, exit, target, watched};

/// Searches for the scene with the largest loss of each prediction
///
/// Samples 12,288 of the scenes that the loss is over, compares the 256 worst with changed distances on 1,024 texels, and refines the
/// 16 worst of these, the best 2 on all texels. Distances have no largest value: the search is within the central 99% of their
/// distributions, which --distance-tail changes. The mean is the loss over all scenes, to +-1% where 49,152 scenes are enough. The JSON is a scene file
/// that `--scenes` takes. Without GT and PRED: the built-in materials.
#[derive(Debug, clap::Args)]
#[command(after_help = "Example:\n  svbrdf worst gt.png a.png")]
pub struct WorstArgs {
    #[command(flatten)]
    seed: SeedArgs,

    /// Leaves out this share of the nearest distances, and as much of the farthest
    #[arg(help_heading = "Scenes", long, value_name = "PERCENT", value_parser = values::percent, allow_hyphen_values = true, default_value = "0.5%")]
    distance_tail: f64,

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
    let truth = &opened.ground_truth;
    let one = |prediction: &Material<f32>| {
        watched("searching", |progress| {
            worst(truth, prediction, &job.convention, args.seed.seed, args.distance_tail, progress)
        })
    };
    let found = opened.predictions.iter().map(one).collect::<Result<Vec<_>, _>>()?;
    let compared = Compared::new(&opened.ground_truth, &job.convention);
    let report = WorstReport::new(compared, args.distance_tail, found);
    exit::put(&args.format.write(&report)?)?;
    target::warn_of(report.missed(), job.materials.strict)
}
