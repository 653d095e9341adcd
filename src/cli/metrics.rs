//! `svbrdf metrics`: metrics beside the loss.

use serde::Serialize;
use svbrdf::error::Error;
use svbrdf::material::Material;
use svbrdf::metrics::{Metric, of_maps, of_renderings};
use svbrdf::model::convention::Convention;

use super::bar::watched;
use super::comparison_args::ComparisonArgs;
use super::report::ReportFormat;
use super::scene_args::SceneArgs;
use super::{exit, materials, table};

/// Prints metrics of maps and renderings, each with its convention in its name
///
/// Root mean square and mean absolute differences of the four maps, angles between normals, and root mean square
/// differences and PSNR of renderings. docs/metrics.md defines each. Without GT and PRED: the built-in materials.
#[derive(Debug, clap::Args)]
pub struct MetricsArgs {
    #[command(flatten)]
    scenes: SceneArgs,

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
    let (sampling, scenes) = args.scenes.scenes(&args.comparison.convention)?;
    let opened = materials::open::<f32>(&args.comparison.materials)?;
    let truth = &opened.ground_truth;
    let one = |prediction: &Material<f32>| -> Result<Vec<Metric>, Error> {
        let renderings = watched("rendering", |progress| {
            of_renderings(truth, prediction, &scenes, &args.comparison.convention, progress)
        })?;
        Ok([of_maps(truth, prediction)?, renderings].concat())
    };
    let metrics = opened.predictions.iter().map(one).collect::<Result<Vec<_>, _>>()?;
    let names: Vec<&str> = opened.predictions.iter().map(Material::name).collect();
    exit::put(&match args.format {
        ReportFormat::Text => {
            let heading = table::heading("metrics", truth, &args.comparison.convention);
            let rows = rows("metric", &names, &metrics, |value| format!("{value:.6}"));
            format!("{heading}{}\n{}", table::scenes_line(sampling.as_ref(), &scenes), table::aligned(&rows))
        }
        ReportFormat::Json => json(truth.name(), &args.comparison.convention, &names, &metrics)?,
        ReportFormat::Csv => table::csv(rows("metric", &names, &metrics, |value| value.to_string()))?,
    })
}

/// A row for each metric, a column for each prediction.
fn rows(
    title: &str,
    names: &[&str],
    metrics: &[Vec<Metric>],
    text: impl Fn(f64) -> String,
) -> Vec<Vec<String>> {
    let heading = [title].into_iter().chain(names.iter().copied()).map(str::to_owned).collect();
    let row = |(index, metric): (usize, &Metric)| {
        let values = metrics.iter().map(|metrics| text(metrics[index].value));
        [metric.name.to_owned()].into_iter().chain(values).collect()
    };
    let first = metrics.first().map(Vec::as_slice).unwrap_or_default();
    [heading].into_iter().chain(first.iter().enumerate().map(row)).collect()
}

#[derive(Serialize)]
struct MetricsJson<'a> {
    ground_truth: &'a str,
    convention: &'a str,
    results: Vec<MetricsEntry<'a>>,
}

#[derive(Serialize)]
struct MetricsEntry<'a> {
    prediction: &'a str,
    /// By name; an infinite PSNR, of equal renderings, is null.
    metrics: serde_json::Map<String, serde_json::Value>,
}

fn json(
    truth: &str,
    convention: &Convention,
    names: &[&str],
    metrics: &[Vec<Metric>],
) -> Result<String, Error> {
    let entry = |(name, metrics): (&&'_ str, &Vec<Metric>)| {
        let value = |metric: &Metric| (metric.name.to_owned(), serde_json::Value::from(metric.value));
        ((*name).to_owned(), metrics.iter().map(value).collect())
    };
    let entries: Vec<(String, serde_json::Map<_, _>)> = names.iter().zip(metrics).map(entry).collect();
    let results =
        entries.iter().map(|(prediction, metrics)| MetricsEntry { prediction, metrics: metrics.clone() });
    table::json(&MetricsJson { ground_truth: truth, convention: convention.name, results: results.collect() })
}
