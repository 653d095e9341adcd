//! `svbrdf worst`: the scene with the largest loss.

use svbrdf_core::material::Material;
use svbrdf_evaluate::report::{Compared, Report as _, WorstReport};
use svbrdf_evaluate::why::worst;

use super::args::scenes::SeedArgs;
use super::args::{ComparisonArgs, Given, values};
use super::job::{ComparisonJob, Job, NewJob};
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

#[derive(Debug)]
struct WorstJob {
    comparison: ComparisonJob,
    seed: u64,
    distance_tail: f64,
    format: ReportFormat,
}

impl WorstArgs {
    pub fn job(self, given: &Given) -> NewJob {
        let Self { seed, distance_tail, format, comparison } = self;
        let comparison = ComparisonJob::with_predictions(&comparison, given)?;
        Ok(Box::new(WorstJob { comparison, seed: seed.seed.unwrap_or(0), distance_tail, format }))
    }
}

/// Prints the worst scenes to stdout; with `--strict` fails where a mean is known less well, after the results are printed.
impl Job for WorstJob {
    fn run(self: Box<Self>) -> Result<(), CommandError> {
        let Self { comparison: ComparisonJob { convention, materials, .. }, seed, distance_tail, format } =
            *self;
        let opened = materials.open::<f32>()?;
        let truth = &opened.ground_truth;
        let one = |prediction: &Material<f32>| {
            watched("searching", |progress| {
                worst(truth, prediction, &convention, seed, distance_tail, progress)
            })
        };
        let found = opened.predictions.iter().map(one).collect::<Result<Vec<_>, _>>()?;
        let report = WorstReport::new(Compared::new(truth, &convention), distance_tail, found);
        exit::put(&format.write(&report)?)?;
        target::warn_of(report.missed(), materials.strict)
    }
}
