//! `svbrdf metrics`: metrics beside the loss.

use svbrdf::error::Error;
use svbrdf::material::Material;
use svbrdf::metrics::{Metric, of_maps, of_renderings};
use svbrdf::report::{Compared, MetricsReport};

use super::bar::watched;
use super::comparison_args::ComparisonArgs;
use super::protocol::{self, ProtocolArgs};
use super::report::ReportFormat;
use super::scene_args::SceneArgs;
use super::{exit, materials, table};

/// Prints metrics of maps and renderings, each with its convention in its name
///
/// Root mean square and mean absolute differences of the four maps, angles between normals, SSIM, and root mean square
/// differences and PSNR of renderings. docs/metrics.md defines each. With --protocol: those of a published evaluation, as
/// its released code computes them. Without GT and PRED: the built-in materials.
#[derive(Debug, clap::Args)]
pub struct MetricsArgs {
    #[command(flatten)]
    scenes: SceneArgs,

    #[command(flatten)]
    protocol: ProtocolArgs,

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
pub fn run(args: &MetricsArgs) -> Result<(), Error> {
    table::check_predictions(&args.comparison.materials)?;
    if args.protocol.is_given() {
        return protocol::run(&args.protocol, &args.comparison, args.format);
    }
    let (sampling, scenes) = args.scenes.scenes(&args.comparison.convention())?;
    let opened = materials::open::<f32>(&args.comparison.materials)?;
    let truth = &opened.ground_truth;
    let one = |prediction: &Material<f32>| -> Result<(String, Vec<Metric>), Error> {
        let renderings = watched("rendering", |progress| {
            of_renderings(truth, prediction, &scenes, &args.comparison.convention(), progress)
        })?;
        Ok((prediction.name().to_owned(), [of_maps(truth, prediction)?, renderings].concat()))
    };
    let results = opened.predictions.iter().map(one).collect::<Result<Vec<_>, _>>()?;
    let compared = Compared::new(truth, &args.comparison.convention());
    exit::put(&args.format.write(&MetricsReport::new(&compared, sampling.as_ref(), &scenes, results))?)
}
