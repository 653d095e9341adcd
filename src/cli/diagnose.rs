//! `svbrdf diagnose`: whether something trivial explains a loss.

use svbrdf_core::material::Material;
use svbrdf_evaluate::diagnose::{Storage, diagnose};
use svbrdf_evaluate::report::{Compared, DiagnoseReport};

use super::args::scenes::SeedArgs;
use super::args::{ComparisonArgs, Given};
use super::job::floor::floor_of;
use super::job::{ComparisonJob, Job, NewJob};
use super::output::{CommandError, ReportFormat, exit, watched};

/// Prints what an exposure, a shift, a symmetry or another reading of the files would lower the loss to
///
/// Each hypothesis is fitted in the scenes of a pilot and evaluated in 3,072 others. A star marks those that lower the loss
/// significantly, and by at least 10% beside the other marked ones. The last column has the option that corrects the reading. Losses below
/// the floor, which the ground truth cannot resolve, have no mark. docs/diagnose.md describes each line. Without GT and PRED: the built-in
/// materials.
#[derive(Debug, clap::Args)]
pub struct DiagnoseArgs {
    #[command(flatten)]
    seed: SeedArgs,

    /// Output format
    #[arg(long, value_enum, default_value_t)]
    format: ReportFormat,

    #[command(flatten)]
    comparison: ComparisonArgs,
}

#[derive(Debug)]
struct DiagnoseJob {
    comparison: ComparisonJob,
    seed: u64,
    format: ReportFormat,
}

impl DiagnoseArgs {
    pub fn job(self, given: &Given) -> NewJob {
        let Self { seed, format, comparison } = self;
        let comparison = ComparisonJob::with_predictions(&comparison, given)?;
        Ok(Box::new(DiagnoseJob { comparison, seed: seed.seed.unwrap_or(0), format }))
    }
}

/// Prints the diagnoses to stdout.
impl Job for DiagnoseJob {
    fn run(self: Box<Self>) -> Result<(), CommandError> {
        let Self { comparison, seed, format } = *self;
        let opened = comparison.materials.open::<f32>()?;
        let (truth, convention) = (&opened.ground_truth, &comparison.convention);
        let floor = floor_of(&comparison, &opened, seed)?;
        let (of_truth, storages) = (&opened.storages[0], &opened.storages[1..]);
        let one = |(prediction, storage): (&Material<f32>, &Storage)| {
            let (pair, storages) = ([truth, prediction], [of_truth, storage]);
            watched("diagnosing", |progress| diagnose(pair, storages, convention, floor.mean, seed, progress))
        };
        let diagnoses = opened.predictions.iter().zip(storages).map(one).collect::<Result<Vec<_>, _>>()?;
        let compared = Compared::new(truth, convention);
        let report = DiagnoseReport::new(compared, seed, floor, diagnoses);
        Ok(exit::put(&format.write(&report)?)?)
    }
}
