//! `svbrdf blame`: how much of a loss comes from each map.

use svbrdf_core::loss::{LossOptions, Request};
use svbrdf_core::material::Material;
use svbrdf_evaluate::report::{BlameReport, Compared, Report as _};
use svbrdf_evaluate::why::attribute;

use super::args::scenes::{AccuracyArgs, ListArgs};
use super::args::{ComparisonArgs, Given};
use super::job::{ComparisonJob, Job, NewJob};
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
#[command(mut_arg("target_error", |arg| arg.help(
    "Samples as many scenes as this relative error of the loss needs at 95% confidence, at most 49,152 [default: 1%]")))]
pub struct BlameArgs {
    #[command(flatten)]
    accuracy: AccuracyArgs,

    #[command(flatten)]
    list: ListArgs,

    /// Output format
    #[arg(long, value_enum, default_value_t)]
    format: ReportFormat,

    #[command(flatten)]
    comparison: ComparisonArgs,
}

#[derive(Debug)]
struct BlameJob {
    comparison: ComparisonJob,
    request: Request,
    format: ReportFormat,
}

impl BlameArgs {
    pub fn job(self, given: &Given) -> NewJob {
        let Self { accuracy, list, format, comparison } = self;
        let comparison = ComparisonJob::with_predictions(&comparison, given)?;
        let options = LossOptions { file: list.file()?, ..accuracy.options() };
        Ok(Box::new(BlameJob { comparison, request: options.question()?.request, format }))
    }
}

/// Prints the attributions to stdout; with `--strict` fails where the target error is not reached, after the results are printed.
impl Job for BlameJob {
    fn run(self: Box<Self>) -> Result<(), CommandError> {
        let Self { comparison: ComparisonJob { convention, materials, .. }, request, format } = *self;
        let opened = materials.open::<f32>()?;
        let truth = &opened.ground_truth;
        let one = |prediction: &Material<f32>| {
            watched("rendering", |progress| attribute(truth, prediction, &convention, &request, progress))
        };
        let attributions = opened.predictions.iter().map(one).collect::<Result<Vec<_>, _>>()?;
        let report = BlameReport::new(Compared::new(truth, &convention), &request, attributions);
        exit::put(&format.write(&report)?)?;
        target::warn_of(report.missed(), materials.strict)
    }
}
