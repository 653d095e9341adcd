//! `svbrdf metrics`: metrics beside the loss.

use serde_json::json;

use svbrdf_evaluate::analyses::AnyAnalysis;
use svbrdf_evaluate::metrics::MetricSelection;
use svbrdf_evaluate::report::MetricsReport;

use super::analysis::AnalysisJob;
use super::args::scenes::SceneArgs;
use super::args::values::stops;
use super::args::{ComparisonArgs, Given, offered};
use super::job::{ComparisonJob, NewJob};
use super::output::ReportFormat;

/// Prints metrics of maps and renderings, each with its convention in its name
///
/// Root mean square and mean absolute differences, PSNR and SSIM of the four maps and of renderings, the same of base colour and
/// metallic, angles between normals, and FLIP of renderings. docs/metrics.md defines each. Without GT and PRED: the
/// built-in materials.
#[derive(Debug, clap::Args)]
pub struct MetricsArgs {
    #[command(flatten)]
    scenes: SceneArgs,

    /// Metrics to compute, by words of their names: psnr, roughness, flip, ... [default: all]
    #[arg(long, value_name = "WORDS,...", value_delimiter = ',')]
    #[arg(value_parser = offered(str::parse::<String>, MetricSelection::words()), hide_possible_values = true)]
    metrics: Vec<String>,

    /// Exposure of renderings in stops, before they are clipped [default: 0]
    #[arg(long, value_name = "EV", value_parser = stops, allow_hyphen_values = true)]
    exposure: Option<f32>,

    /// Output format
    #[arg(long, value_enum, default_value_t)]
    format: ReportFormat,

    #[command(flatten)]
    comparison: ComparisonArgs,
}

impl MetricsArgs {
    pub fn job(self, given: &Given) -> NewJob {
        let Self { scenes, metrics, exposure, format, comparison: args } = self;
        let comparison = ComparisonJob::with_predictions(&args, given)?;
        let metrics = MetricSelection::try_from(metrics)?;
        let analysis = AnyAnalysis::of::<MetricsReport>();
        let (request, options) = (
            analysis.request(&scenes.options()?)?,
            json!({ "exposure": exposure.unwrap_or(0.0), "metrics": metrics }),
        );
        Ok(Box::new(AnalysisJob { analysis, comparison, request, options, format }))
    }
}
