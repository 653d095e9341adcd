//! `svbrdf metrics`: metrics beside the loss.

use svbrdf_core::error::Error;
use svbrdf_core::material::Material;
use svbrdf_core::model::sampler::Sampler;
use svbrdf_evaluate::metrics::{Metric, RenderedScenes, of_maps, of_renderings};
use svbrdf_evaluate::report::{Compared, MetricsReport};

use super::args::scenes::SceneArgs;
use super::args::values::stops;
use super::args::{ComparisonArgs, Given, modes};
use super::job::ComparisonJob;
use super::output::report::ReportFormat;
use super::output::{CommandError, exit, watched};
use super::protocol::{self, ProtocolArgs};

/// Prints metrics of maps and renderings, each with its convention in its name
///
/// Root mean square and mean absolute differences, PSNR and SSIM of the four maps and of renderings, the same of base colour and
/// metallic, angles between normals, and FLIP of renderings. docs/metrics.md defines each. With --protocol: those of a published evaluation, as
/// its released code computes them. Without GT and PRED: the built-in materials.
#[derive(Debug, clap::Args)]
#[command(after_help = "Example:\n  svbrdf metrics gt.png a.png b.png --format csv")]
pub struct MetricsArgs {
    #[command(flatten)]
    scenes: SceneArgs,

    #[command(flatten)]
    protocol: ProtocolArgs,

    /// Exposure of renderings in stops, before they are clipped
    #[arg(long, value_name = "EV", value_parser = stops, allow_hyphen_values = true, default_value_t = 0.0)]
    exposure: f32,

    /// Output format
    #[arg(long, value_enum, default_value_t)]
    format: ReportFormat,

    #[command(flatten)]
    comparison: ComparisonArgs,
}

/// Prints the metrics to stdout.
///
/// # Errors
/// Where a material or the scenes cannot be read or used.
pub fn run(args: &MetricsArgs, given: &Given) -> Result<(), CommandError> {
    let job = ComparisonJob::new(&args.comparison, given)?;
    job.materials.check_predictions()?;
    if args.protocol.is_given() {
        given.check(&modes::PROTOCOL)?;
        return protocol::run(&args.protocol, &job, args.format);
    }
    given.check(&modes::NO_PROTOCOL)?;
    let (sampling, scenes) = args.scenes.scenes(&job.convention, given)?;
    let rendered = RenderedScenes {
        scenes: &scenes,
        sampler: sampling.map_or(Sampler::Random, |sampling| sampling.sampler),
        convention: &job.convention,
        exposure_ev: args.exposure,
    };
    let opened = job.materials.open::<f32>()?;
    let truth = &opened.ground_truth;
    let one = |prediction: &Material<f32>| -> Result<(String, Vec<Metric>), Error> {
        let renderings =
            watched("rendering", |progress| of_renderings(truth, prediction, &rendered, progress))?;
        Ok((prediction.name().to_owned(), [of_maps(truth, prediction)?, renderings].concat()))
    };
    let results = opened.predictions.iter().map(one).collect::<Result<Vec<_>, _>>()?;
    let compared = Compared::new(truth, &job.convention);
    let report = MetricsReport::new(&compared, sampling.as_ref(), &rendered, results);
    Ok(exit::put(&args.format.write(&report)?)?)
}
