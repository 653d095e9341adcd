//! Metrics of the maps of a data set beside the losses.

use std::collections::BTreeMap;

use crate::report::{aligned, bold, escaped, latex};

use super::metric_summary::{MetricSummary, best_by_metric, is_better_larger, summarize_metrics};
use super::ranking::DatasetReport;
use super::record::MaterialResult;

/// The names of the metrics of the results.
pub(super) fn names(results: &[MaterialResult]) -> Vec<&str> {
    let first = results.iter().flat_map(|result| &result.predictions).find(|p| !p.metrics.is_empty());
    first.into_iter().flat_map(|prediction| prediction.metrics.keys()).map(String::as_str).collect()
}

/// A table of the means over materials with their intervals, a column for each method; empty without metrics.
pub(super) fn text(report: &DatasetReport) -> String {
    let names = names(&report.results);
    if names.is_empty() {
        return String::new();
    }
    let columns = columns(report);
    let mut heading = vec!["metric, mean over materials".to_owned()];
    heading
        .extend(report.ranking.methods.iter().flat_map(|summary| [summary.method.clone(), "95%".to_owned()]));
    let row = |name: &str| {
        let cells = columns.iter().flat_map(|metrics| cells(metrics.get(name)));
        [name.to_owned()].into_iter().chain(cells).collect()
    };
    let rows: Vec<Vec<String>> = [heading].into_iter().chain(names.iter().map(|name| row(name))).collect();
    format!("\n{}", aligned(&rows))
}

/// The means over materials as a LaTeX table with a column for each method: in bold the best one and what ties with it. Empty
/// without metrics.
pub(super) fn latex_table(report: &DatasetReport) -> String {
    let methods = &report.ranking.methods;
    let best = best_by_metric(report);
    if best.is_empty() {
        return String::new();
    }
    let columns = columns(report);
    let row = |(name, best): (&String, &Vec<bool>)| {
        let cell = |(metrics, &best): (&BTreeMap<String, MetricSummary>, &bool)| {
            metrics.get(name).map_or("--".to_owned(), |metric| bold(&number(metric.mean), best))
        };
        let cells: Vec<String> = columns.iter().zip(best).map(cell).collect();
        let arrow = if is_better_larger(name) { "$\\uparrow$" } else { "$\\downarrow$" };
        format!("{} {arrow} & {} \\\\\n", escaped(name), cells.join(" & "))
    };
    let rows: String = best.iter().map(row).collect();
    let names: Vec<String> = methods.iter().map(|summary| escaped(&summary.method)).collect();
    let heading = format!("Metric, mean over materials & {}", names.join(" & "));
    format!("\n{}", latex(&format!("l{}", "r".repeat(methods.len())), &heading, &rows))
}

/// The metrics of each method.
fn columns(report: &DatasetReport) -> Vec<BTreeMap<String, MetricSummary>> {
    report.ranking.methods.iter().map(|method| summarize_metrics(report, method)).collect()
}

/// A number in LaTeX.
fn number(value: f64) -> String {
    if value.is_infinite() { "$\\infty$".to_owned() } else { format!("{value:.4}") }
}

fn cells(metric: Option<&MetricSummary>) -> [String; 2] {
    let mean = metric.map_or("-".to_owned(), |metric| format!("{:.6}", metric.mean));
    let interval = metric.and_then(|metric| metric.interval95_materials);
    let interval = interval.map_or("-".to_owned(), |[low, high]| format!("{low:.6} to {high:.6}"));
    [mean, interval]
}
