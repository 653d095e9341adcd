//! `svbrdf scenes`: the scenes with the largest losses.

use svbrdf_core::loss::{Comparison, Request};
use svbrdf_evaluate::report::{Compared, ScenesReport};

use super::args::scenes::SceneArgs;
use super::args::values::whole;
use super::args::{ComparisonArgs, Given};
use super::job::{ComparisonJob, Job, NewJob};
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

#[derive(Debug)]
struct ScenesJob {
    comparison: ComparisonJob,
    request: Request,
    top: usize,
    format: ReportFormat,
}

impl ScenesArgs {
    pub fn job(self, given: &Given) -> NewJob {
        let Self { top, scenes, format, comparison } = self;
        let comparison = ComparisonJob::with_predictions(&comparison, given)?;
        Ok(Box::new(ScenesJob { comparison, request: scenes.options()?.listed()?, top, format }))
    }
}

/// Prints the scenes to stdout.
impl Job for ScenesJob {
    fn run(self: Box<Self>) -> Result<(), CommandError> {
        let Self { comparison: ComparisonJob { convention, materials, .. }, request, top, format } = *self;
        let opened = materials.open::<f32>()?;
        let predictions: Vec<_> = opened.predictions.iter().collect();
        let comparison = Comparison::new(&opened.ground_truth, &predictions, convention)?.without_pilot();
        let outcome = watched("rendering", |progress| comparison.run(&request, progress))?;
        let compared = Compared::new(&opened.ground_truth, &convention);
        Ok(exit::put(&format.write(&ScenesReport::new(compared, &outcome, top))?)?)
    }
}
