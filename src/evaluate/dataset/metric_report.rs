//! Metrics of the maps of a data set beside the losses.

use crate::report::{Cell, Table, bold, escaped, latex};

use super::metric_summary::{best_by_metric, is_better_larger};
use super::ranking::MethodSummary;
use super::record::MaterialResult;
use super::report::DatasetReport;

/// The names of the metrics of the results.
pub(super) fn names(results: &[MaterialResult]) -> Vec<&str> {
    let first = results.iter().flat_map(|result| &result.predictions).find(|p| !p.metrics.is_empty());
    first.into_iter().flat_map(|prediction| prediction.metrics.keys()).map(String::as_str).collect()
}

/// The means over materials with their intervals, two columns for each method; `None` without metrics.
pub(super) fn table(report: &DatasetReport) -> Option<Table> {
    let methods = report.methods.iter();
    let titles = methods.flat_map(|summary| [summary.method.as_str(), "95%"]);
    let row = |name: &str| {
        let cells = report.methods.iter().flat_map(|summary| {
            let metric = summary.metrics.get(name);
            let interval = metric.and_then(|metric| metric.interval95_materials);
            [Cell::or(metric.map(|metric| metric.mean), "-"), Cell::or(interval, "-")]
        });
        [name.into()].into_iter().chain(cells).collect()
    };
    let rows: Vec<_> = names(&report.results).into_iter().map(row).collect();
    let titles = ["metric, mean over materials"].into_iter().chain(titles);
    (!rows.is_empty()).then(|| Table::new(titles, rows))
}

/// The means over materials as a LaTeX table with a column for each method: in bold the best one and what ties with it. Empty
/// without metrics.
pub(super) fn latex_table(report: &DatasetReport) -> String {
    let methods = &report.methods;
    let best = best_by_metric(report);
    if best.is_empty() {
        return String::new();
    }
    let row = |(name, best): (&String, &Vec<bool>)| {
        let cell = |(method, &best): (&MethodSummary, &bool)| {
            method.metrics.get(name).map_or("--".to_owned(), |metric| bold(&number(metric.mean), best))
        };
        let cells: Vec<String> = methods.iter().zip(best).map(cell).collect();
        let arrow = if is_better_larger(name) { "$\\uparrow$" } else { "$\\downarrow$" };
        format!("{} {arrow} & {} \\\\\n", escaped(name), cells.join(" & "))
    };
    let rows: String = best.iter().map(row).collect();
    let names: Vec<String> = methods.iter().map(|summary| escaped(&summary.method)).collect();
    let heading = format!("Metric, mean over materials & {}", names.join(" & "));
    format!("\n{}", latex(&format!("l{}", "r".repeat(methods.len())), &heading, &rows))
}

/// A number in LaTeX.
fn number(value: f64) -> String {
    if value.is_infinite() { "$\\infty$".to_owned() } else { format!("{value:.4}") }
}
