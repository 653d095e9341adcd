//! Metrics of maps over the materials of a ranking, and their tables beside those of the losses.

use std::collections::{BTreeMap, BTreeSet};
use std::ops::RangeInclusive;

use crate::protocols::{Aggregate, Row};
use crate::report::{Cell, Table};
use svbrdf_core::statistics::median;

use super::bootstrap::{interval_of_mean_within, may_be_0};
use super::pick::counted;
use super::record::MaterialResult;
use super::summary::{DatasetReport, FEW, MethodSummary, MetricSummary};

/// The beginnings of the names of what is of all materials together, before those of the metric.
const POOLED: &str = "psnr_pooled_";
const POOLED_ROOT: &str = "rmse_pooled_";

/// Words of the maps in the names of metrics, whose values are in [0, 1].
const MAPS: [&str; 6] = ["_normal", "_diffuse", "_specular", "_roughness", "_base", "_metallic"];

/// How values of a metric are averaged: as errors, of which less is better.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Scale {
    /// The metric itself, of 0 or more.
    Error,
    /// 1 - the similarity, which is at least -1.
    Similarity,
    /// A PSNR in dB, as papers average it, less being worse; that of equal maps is infinite, and in no mean.
    Decibel,
    /// The mean square error of a PSNR, in squares of the range: that of all texels of materials of one size.
    Pooled,
    /// The same of an RMSE.
    PooledRoot,
}

impl Scale {
    fn of(metric: &str) -> Self {
        match metric {
            _ if metric.starts_with("ssim") => Self::Similarity,
            _ if metric.starts_with(POOLED) => Self::Pooled,
            _ if metric.starts_with(POOLED_ROOT) => Self::PooledRoot,
            _ if metric.starts_with("psnr") => Self::Decibel,
            _ => Self::Error,
        }
    }

    fn error(self, value: f64) -> f64 {
        match self {
            Self::Error => value,
            Self::Similarity => 1.0 - value,
            Self::Decibel => -value,
            Self::Pooled => 10_f64.powf(-value / 10.0),
            Self::PooledRoot => value * value,
        }
    }

    fn value(self, error: f64) -> f64 {
        match self {
            Self::Error => error,
            Self::Similarity => (1.0 - error).max(-1.0),
            Self::Decibel => -error,
            Self::Pooled => -10.0 * error.log10(),
            Self::PooledRoot => error.sqrt(),
        }
    }

    /// The range of the errors of a metric by name.
    fn range(self, metric: &str) -> RangeInclusive<f64> {
        let is_of = |what: &str| metric.contains(what);
        let of_map =
            MAPS.iter().any(|map| is_of(map)) && ["rmse_", "l1_"].iter().any(|one| metric.starts_with(one));
        match self {
            Self::Similarity => 0.0..=2.0,
            Self::Decibel => f64::NEG_INFINITY..=0.0,
            Self::Pooled | Self::PooledRoot => 0.0..=1.0,
            Self::Error if metric.starts_with("angle_") => 0.0..=180.0,
            Self::Error if of_map && (is_of("_minus1_to_1") || is_of("_unit")) => 0.0..=2.0,
            Self::Error if of_map => 0.0..=1.0,
            Self::Error => 0.0..=f64::INFINITY,
        }
    }

    fn interval_of(self, metric: &str, errors: &[f64]) -> Option<[f64; 2]> {
        self.interval(interval_of_mean_within(errors, &self.range(metric))?)
    }

    /// The interval of values, from that of errors.
    fn interval(self, errors: [f64; 2]) -> Option<[f64; 2]> {
        let [a, b] = errors.map(|error| self.value(error));
        Some([a.min(b), a.max(b)]).filter(|ends| ends.iter().all(|end| end.is_finite()))
    }
}

/// The metrics of a method of a report by name. Of several predictions of a material, those count that count for the loss.
pub(super) fn summarize_metrics(
    report: &DatasetReport,
    method: &MethodSummary,
) -> BTreeMap<String, MetricSummary> {
    let summary = |(name, errors): (String, BTreeMap<usize, f64>)| {
        let (scale, mut all) = (Scale::of(&name), errors.values().copied().collect::<Vec<_>>());
        let summary = MetricSummary {
            mean: scale.value(mean(&errors)),
            infinite: all.iter().filter(|error| error.is_infinite()).count(),
            interval95_materials: scale.interval_of(&name, &finite(&errors)),
            median: scale.value(median(&mut all).unwrap_or(f64::NAN)),
        };
        (name, summary)
    };
    let asked: BTreeSet<String> = rows(report).into_iter().map(|row| row.metric).collect();
    let errors = errors_of(report, method).into_iter();
    errors.filter(|(name, _)| asked.contains(name)).map(summary).collect()
}

/// A row of the tables of metrics.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MetricRow {
    /// The name of the metric, or of what is pooled over materials.
    pub metric: String,
    /// What the protocol calls it.
    pub label: Option<String>,
    is_median: bool,
}

impl MetricRow {
    /// What the row has of a method, with its interval.
    pub fn value(&self, summary: &MethodSummary) -> Option<(f64, Option<[f64; 2]>)> {
        let metric = summary.metrics.get(&self.metric)?;
        Some(if self.is_median { (metric.median, None) } else { (metric.mean, metric.interval95_materials) })
    }

    /// The label of the protocol before the name.
    pub fn title(&self) -> String {
        let median = if self.is_median { ", median" } else { "" };
        let label = self.label.as_ref().map_or(String::new(), |label| format!("{label}: "));
        format!("{label}{}{median}", self.metric)
    }
}

/// The rows of the tables: those of the protocol, or the metrics that are asked for.
fn rows(report: &DatasetReport) -> Vec<MetricRow> {
    if let Some(protocol) = &report.settings.protocol {
        let of = |row: &Row| MetricRow {
            metric: row.summary(),
            label: Some(row.label.clone()),
            is_median: row.over_materials == Aggregate::Median,
        };
        return protocol.metrics.iter().map(of).collect();
    }
    let asked = |name: &&str| report.settings.metrics.as_ref().is_some_and(|metrics| metrics.has(name));
    let names = metric_names(&report.results).into_iter().filter(asked);
    let all: BTreeSet<String> =
        names.flat_map(|name| [Some(name.to_owned()), pooled(name)]).flatten().collect();
    all.into_iter().map(|metric| MetricRow { metric, label: None, is_median: false }).collect()
}

/// Whether larger values of a metric are better ones: similarities and signal-to-noise ratios.
pub(super) fn is_better_larger(metric: &str) -> bool {
    !matches!(Scale::of(metric), Scale::Error | Scale::PooledRoot)
}

/// For each row: which methods of the ranking are the best one, or cannot be separated from it. Only methods that are compared
/// are; a method ties with the best one where the 95% interval of the mean of their differences includes 0 or is unknown.
pub fn best_by_metric(report: &DatasetReport) -> Vec<(MetricRow, Vec<bool>)> {
    let methods = &report.methods;
    let errors: Vec<_> = methods.iter().map(|method| errors_of(report, method)).collect();
    let best_of = |row: &MetricRow| -> Vec<bool> {
        let of = methods.iter().zip(&errors);
        let compared = of.map(|(method, errors)| errors.get(&row.metric).filter(|_| method.compared));
        let best = compared.clone().flatten().min_by(|a, b| mean(a).total_cmp(&mean(b)));
        compared.map(|errors| errors.zip(best).is_some_and(|(errors, best)| ties(errors, best))).collect()
    };
    known_rows(report).map(|row| (row.clone(), best_of(&row))).collect()
}

/// The rows that any method has.
fn known_rows(report: &DatasetReport) -> impl Iterator<Item = MetricRow> {
    let has_any = |row: &MetricRow| report.methods.iter().any(|method| row.value(method).is_some());
    rows(report).into_iter().filter(has_any)
}

/// Whether the materials of both cannot separate a method from the best one.
fn ties(errors: &BTreeMap<usize, f64>, best: &BTreeMap<usize, f64>) -> bool {
    let paired = errors.iter().filter_map(|(material, error)| Some(error - best.get(material)?));
    // Infinite ones on both sides are equal.
    let paired: Vec<f64> =
        paired.map(|difference| if difference.is_nan() { 0.0 } else { difference }).collect();
    let (known, infinite): (Vec<f64>, Vec<f64>) = paired.iter().partition(|one| one.is_finite());
    let worse = infinite.iter().filter(|difference| **difference > 0.0).count();
    2 * worse <= paired.len() && may_be_0(&known)
}

/// The mean of the finite errors, or of all where none is: maps that are equal for every material have an infinite PSNR.
fn mean(errors: &BTreeMap<usize, f64>) -> f64 {
    let of = |values: &[f64]| values.iter().sum::<f64>() / values.len() as f64;
    let finite = finite(errors);
    if finite.is_empty() { of(&errors.values().copied().collect::<Vec<_>>()) } else { of(&finite) }
}

fn finite(errors: &BTreeMap<usize, f64>) -> Vec<f64> {
    errors.values().copied().filter(|error| error.is_finite()).collect()
}

/// The errors of each metric by the index of the material.
type Errors = BTreeMap<String, BTreeMap<usize, f64>>;

fn errors_of(report: &DatasetReport, method: &MethodSummary) -> Errors {
    let mut errors = Errors::new();
    let is_over = |result: &&MaterialResult| !method.compared || report.common.contains(&result.index);
    for result in report.results.iter().filter(is_over) {
        let counted = counted(result, &method.method, report.pick);
        for name in counted.first().map(|prediction| prediction.metrics.keys()).into_iter().flatten() {
            for averaged in [Some(name.clone()), pooled(name), pooled_root(name)].into_iter().flatten() {
                let scale = Scale::of(&averaged);
                let all = counted.iter().filter_map(|prediction| prediction.metrics.get(name));
                let sum: f64 = all.map(|value| scale.error(*value)).sum();
                errors.entry(averaged).or_default().insert(result.index, sum / counted.len() as f64);
            }
        }
    }
    errors
}

/// The name of the PSNR of all materials together, where this is that of one.
fn pooled(metric: &str) -> Option<String> {
    metric.strip_prefix("psnr_").map(|of| format!("{POOLED}{of}"))
}

/// The name of the RMSE of all materials together, where this is that of one.
fn pooled_root(metric: &str) -> Option<String> {
    metric.strip_prefix("rmse_").map(|of| format!("{POOLED_ROOT}{of}"))
}

/// The names of the metrics of the results.
pub(super) fn metric_names(results: &[MaterialResult]) -> Vec<&str> {
    let first = results.iter().flat_map(|result| &result.predictions).find(|p| !p.metrics.is_empty());
    first.into_iter().flat_map(|prediction| prediction.metrics.keys()).map(String::as_str).collect()
}

/// The means over materials with their intervals, two columns for each method; `None` without metrics. A method that is not compared has the
/// number of its materials in its title.
pub(super) fn metrics_table(report: &DatasetReport) -> Option<Table> {
    let methods = report.methods.iter();
    let titles = methods.flat_map(|summary| [method_title(summary), "95%".to_owned()]);
    let row = |row: MetricRow| {
        let cells = report.methods.iter().flat_map(|summary| {
            let known = row.value(summary);
            [
                Cell::or(known.map(|known| known.0), "-"),
                Cell::or(known.and_then(|known| known.1), known.map_or("-", |_| FEW)),
            ]
        });
        [row.title().into()].into_iter().chain(cells).collect()
    };
    let rows: Vec<_> = known_rows(report).map(row).collect();
    let titles = ["metric, mean over materials".to_owned()].into_iter().chain(titles);
    (!rows.is_empty()).then(|| Table::new(titles, rows))
}

/// The name of a method, with the number of its materials where its means are over others than those of the compared ones.
pub(super) fn method_title(summary: &MethodSummary) -> String {
    match summary.compared {
        true => summary.method.clone(),
        false => format!("{} ({} materials)", summary.method, summary.count()),
    }
}
