//! `svbrdf scenes`: which scenes a loss comes from.

use svbrdf::error::Error;
use svbrdf::loss::Comparison;
use svbrdf::report::{Compared, ScenesReport};

use super::bar::watched;
use super::comparison_args::ComparisonArgs;
use super::report::ReportFormat;
use super::scene_args::SceneArgs;
use super::{exit, materials, table};

/// Prints the scenes with the largest losses, worst first
///
/// Scenes are sorted by the mean of the losses of all predictions in them, over all texels. The JSON is a scene file that
/// `--scenes` takes. Without GT and PRED: the built-in materials.
#[derive(Debug, clap::Args)]
pub struct ScenesArgs {
    /// Number of scenes that are printed
    #[arg(long, value_name = "N", default_value_t = 10)]
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
pub fn run(args: &ScenesArgs) -> Result<(), Error> {
    table::check_predictions(&args.comparison.materials)?;
    let request = args.scenes.request()?;
    let opened = materials::open::<f32>(&args.comparison.materials)?;
    let predictions: Vec<_> = opened.predictions.iter().collect();
    let comparison =
        Comparison::new(&opened.ground_truth, &predictions, args.comparison.convention())?.without_pilot();
    let outcome = watched("rendering", |progress| comparison.run(&request, progress))?;
    let compared = Compared::new(&opened.ground_truth, &args.comparison.convention());
    exit::put(&args.format.write(&ScenesReport::new(compared, outcome).top(args.top))?)
}
