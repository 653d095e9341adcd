//! Marks of the predictions of a data set beside the losses.

use std::collections::BTreeSet;

use crate::report::aligned;

use super::mark_summary::{MarkSummary, summarize_marks};
use super::ranking::DatasetReport;

/// The table of [`rows`] as text; empty without diagnoses.
pub(super) fn text(report: &DatasetReport) -> String {
    let rows = rows(report);
    if rows.is_empty() { String::new() } else { format!("\n{}", aligned(&rows)) }
}

/// The numbers of materials, a column for each method, below a row of headings; no rows without diagnoses.
pub(crate) fn rows(report: &DatasetReport) -> Vec<Vec<String>> {
    let methods = &report.ranking.methods;
    let columns: Vec<Option<MarkSummary>> =
        methods.iter().map(|summary| summarize_marks(report, summary)).collect();
    let known: Vec<&MarkSummary> = columns.iter().flatten().collect();
    if known.is_empty() {
        return Vec::new();
    }
    let row = |name: &str, number: &dyn Fn(&MarkSummary) -> Option<usize>| {
        let cell = |column: &Option<MarkSummary>| {
            column.as_ref().and_then(number).map_or_else(|| "-".to_owned(), |number| number.to_string())
        };
        std::iter::once(name.to_owned()).chain(columns.iter().map(cell)).collect::<Vec<String>>()
    };
    let heading = ["number of materials".to_owned()];
    let mut rows: Vec<Vec<String>> =
        vec![heading.into_iter().chain(methods.iter().map(|summary| summary.method.clone())).collect()];
    rows.push(row("diagnosed", &|marks| Some(marks.materials)));
    rows.push(row("marked", &|marks| Some(marks.marked)));
    let names: BTreeSet<&String> = known.iter().flat_map(|marks| marks.by.keys()).collect();
    rows.extend(
        names
            .into_iter()
            .map(|name| row(&format!("by {name}"), &|marks| Some(marks.by.get(name).copied().unwrap_or(0)))),
    );
    rows.push(row("loss not resolvable", &|marks| Some(marks.not_resolvable)));
    rows.push(row("- best not resolvable", &|marks| marks.to_best_not_resolvable));
    rows
}
