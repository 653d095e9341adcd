//! Marks of diagnoses over all materials, and their table beside that of the losses.

use std::collections::{BTreeMap, BTreeSet};

use crate::report::{Cell, Table};

use super::pick::{counted, counted_loss};
use super::record::PredictionResult;
use super::summary::{DatasetReport, MarkSummary};

/// The marks of a method over all materials that it has, beside the `best` method; `None` where no prediction was diagnosed.
/// Of several predictions of a material, those count that count for the loss; the material has the marks of all of them.
pub(super) fn summarize_marks(
    report: &DatasetReport,
    method: &str,
    best: Option<&str>,
) -> Option<MarkSummary> {
    let DatasetReport { results, pick, .. } = report;
    let best = best.filter(|best| *best != method);
    let mut summary = MarkSummary {
        materials: 0,
        marked: 0,
        by: BTreeMap::new(),
        not_resolvable: 0,
        to_best_not_resolvable: best.map(|_| 0),
    };
    for result in results {
        let of = |prediction: &&PredictionResult| prediction.marks.is_some();
        let diagnosed: Vec<_> = counted(result, method, *pick).into_iter().filter(of).collect();
        if diagnosed.is_empty() {
            continue;
        }
        summary.materials += 1;
        let marks = diagnosed.iter().flat_map(|prediction| prediction.marks.iter().flatten());
        let names: BTreeSet<&str> = marks.map(|mark| mark.hypothesis.as_str()).collect();
        summary.marked += usize::from(!names.is_empty());
        names.into_iter().for_each(|name| *summary.by.entry(name.to_owned()).or_default() += 1);
        let loss = |method: &str| counted_loss(result, method, *pick).map(|known| known.loss);
        summary.not_resolvable += usize::from(result.is_below_floor(loss(method)));
        if let (Some(best), Some(count)) = (best, &mut summary.to_best_not_resolvable) {
            let difference = loss(method).zip(loss(best)).map(|(a, b)| (a - b).abs());
            *count += usize::from(result.is_below_floor(difference));
        }
    }
    (summary.materials > 0).then_some(summary)
}

/// Numbers of materials, a column for each method; `None` without diagnoses.
pub(super) fn marks_table(report: &DatasetReport) -> Option<Table> {
    let marks = || report.methods.iter().map(|summary| summary.marks.as_ref());
    let names: BTreeSet<&String> = marks().flatten().flat_map(|marks| marks.by.keys()).collect();
    let row = |name: &str, number: &dyn Fn(&MarkSummary) -> Option<usize>| {
        let cell = |marks: Option<&MarkSummary>| Cell::or(marks.and_then(number), "-");
        [name.into()].into_iter().chain(marks().map(cell)).collect()
    };
    let by =
        |name: &String| row(&format!("by {name}"), &|marks| Some(marks.by.get(name).copied().unwrap_or(0)));
    let start =
        [row("diagnosed", &|marks| Some(marks.materials)), row("marked", &|marks| Some(marks.marked))];
    let end = [
        row("loss not resolvable", &|marks| Some(marks.not_resolvable)),
        row("- best not resolvable", &|marks| marks.to_best_not_resolvable),
    ];
    let rows = start.into_iter().chain(names.into_iter().map(by)).chain(end);
    let methods = report.methods.iter().map(|summary| summary.method.as_str());
    marks()
        .any(|marks| marks.is_some())
        .then(|| Table::new(["number of materials"].into_iter().chain(methods), rows))
}
