//! Metrics of predictions as a table and as JSON.

use serde::Serialize;
use svbrdf::error::Error;
use svbrdf::metrics::Metric;

use super::table;

/// A row for each metric, a column for each prediction.
pub fn rows(names: &[&str], metrics: &[Vec<Metric>], text: impl Fn(f64) -> String) -> Vec<Vec<String>> {
    let heading = ["metric"].into_iter().chain(names.iter().copied()).map(str::to_owned).collect();
    let row = |(index, metric): (usize, &Metric)| {
        let values = metrics.iter().map(|metrics| text(metrics[index].value));
        [metric.name.to_owned()].into_iter().chain(values).collect()
    };
    let first = metrics.first().map(Vec::as_slice).unwrap_or_default();
    [heading].into_iter().chain(first.iter().enumerate().map(row)).collect()
}

/// The subject of metrics.
#[derive(Serialize)]
pub struct MetricsHeading<'a> {
    pub ground_truth: &'a str,
    /// The convention of the rendering loss that renderings have.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub convention: Option<&'a str>,
    /// The published evaluation.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub protocol: Option<&'a str>,
}

#[derive(Serialize)]
struct MetricsJson<'a> {
    #[serde(flatten)]
    heading: &'a MetricsHeading<'a>,
    results: Vec<MetricsEntry<'a>>,
}

#[derive(Serialize)]
struct MetricsEntry<'a> {
    prediction: &'a str,
    /// By name; an infinite PSNR, of equal renderings, is null.
    metrics: serde_json::Map<String, serde_json::Value>,
}

/// The metrics of each prediction as JSON.
///
/// # Errors
/// [`Error::Internal`].
pub fn json(heading: &MetricsHeading<'_>, names: &[&str], metrics: &[Vec<Metric>]) -> Result<String, Error> {
    let value = |metric: &Metric| (metric.name.to_owned(), serde_json::Value::from(metric.value));
    let entry = |(&prediction, metrics)| {
        let metrics: &Vec<Metric> = metrics;
        MetricsEntry { prediction, metrics: metrics.iter().map(value).collect() }
    };
    table::json(&MetricsJson { heading, results: names.iter().zip(metrics).map(entry).collect() })
}
