//! Metrics of maps over all materials.

use std::collections::{BTreeMap, BTreeSet};

use serde::Serialize;

use svbrdf_core::statistics::median;

use super::bootstrap::interval_of_mean;
use super::record::{MaterialResult, PredictionResult};
use super::summary::Pick;

/// A metric of a method over the materials that it has a prediction of.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct MetricSummary {
    pub mean: f64,
    pub median: f64,
    /// The 95% interval of the mean over all materials like these; `None` for fewer than 3, and where the mean is infinite: of the
    /// PSNR, where maps of a material are equal.
    pub interval95_materials: Option<[f64; 2]>,
}

/// The metrics of `method` by name. Of several predictions of a material, those count that count for the loss.
pub fn summarize_metrics(
    method: &str,
    results: &[MaterialResult],
    pick: Pick,
) -> BTreeMap<String, MetricSummary> {
    let summary = |(name, values): (&str, BTreeMap<usize, f64>)| {
        let mut values: Vec<f64> = values.into_values().collect();
        let mean = mean(&values);
        let interval95_materials = interval_of_mean(&values);
        let median = median(&mut values).unwrap_or(f64::NAN);
        (name.to_owned(), MetricSummary { mean, median, interval95_materials })
    };
    values_of(method, results, pick).into_iter().map(summary).collect()
}

/// Whether larger values of a metric are better ones: similarities and signal-to-noise ratios.
pub fn is_better_larger(metric: &str) -> bool {
    ["ssim", "psnr"].iter().any(|start| metric.starts_with(start))
}

/// For each metric by name: which of `methods` is the best one, or cannot be separated from it. That is where the 95% interval of the
/// mean of their differences, over the materials of both, includes 0 or is unknown; or where an infinite one is not worse.
pub fn best_by_metric(
    methods: &[&str],
    results: &[MaterialResult],
    pick: Pick,
) -> BTreeMap<String, Vec<bool>> {
    let values: Vec<_> = methods.iter().map(|method| values_of(method, results, pick)).collect();
    let names: BTreeSet<&str> = values.iter().flat_map(|values| values.keys().copied()).collect();
    let none = BTreeMap::new();
    let best_of = |name: &str| {
        let sign = if is_better_larger(name) { -1.0 } else { 1.0 };
        let of: Vec<&BTreeMap<usize, f64>> =
            values.iter().map(|values| values.get(name).unwrap_or(&none)).collect();
        let known = of.iter().filter(|values| !values.is_empty());
        let cost = |values: &BTreeMap<usize, f64>| sign * mean(&values.values().copied().collect::<Vec<_>>());
        let best = known.min_by(|a, b| cost(a).total_cmp(&cost(b)));
        let ties = |values: &&BTreeMap<usize, f64>| {
            let Some(best) = best.filter(|_| !values.is_empty()) else { return false };
            let paired = values
                .iter()
                .filter_map(|(material, value)| Some(sign * difference(*value, *best.get(material)?)));
            let paired: Vec<f64> = paired.collect();
            let is_worse = mean(&paired) == f64::INFINITY;
            !is_worse && interval_of_mean(&paired).is_none_or(|[low, _]| low <= 0.0)
        };
        of.iter().map(ties).collect()
    };
    names.into_iter().map(|name| (name.to_owned(), best_of(name))).collect()
}

/// a - b, and 0 for two infinities.
fn difference(a: f64, b: f64) -> f64 {
    if a == b { 0.0 } else { a - b }
}

fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

/// For each metric the value of each material, by its index among all.
fn values_of<'a>(
    method: &str,
    results: &'a [MaterialResult],
    pick: Pick,
) -> BTreeMap<&'a str, BTreeMap<usize, f64>> {
    let mut values: BTreeMap<&str, BTreeMap<usize, f64>> = BTreeMap::new();
    for result in results {
        let counted = counted(result, method, pick);
        for name in counted.first().map(|prediction| prediction.metrics.keys()).into_iter().flatten() {
            let all = counted.iter().filter_map(|prediction| prediction.metrics.get(name));
            values.entry(name).or_default().insert(result.index, all.sum::<f64>() / counted.len() as f64);
        }
    }
    values
}

/// The predictions of a material by a method that count: those with a loss.
pub(super) fn counted<'a>(result: &'a MaterialResult, method: &str, pick: Pick) -> Vec<&'a PredictionResult> {
    let mut of_method = result.predictions.iter().filter(|prediction| prediction.method == method);
    let loss =
        |prediction: &PredictionResult| prediction.result.as_ref().map_or(f64::INFINITY, |known| known.loss);
    let has_loss = |prediction: &&PredictionResult| prediction.result.is_ok();
    match pick {
        Pick::Fixed => of_method.next().filter(has_loss).into_iter().collect(),
        Pick::Best => {
            let known = of_method.filter(has_loss);
            known.min_by(|a, b| loss(a).total_cmp(&loss(b))).into_iter().collect()
        }
        Pick::Mean => of_method.filter(has_loss).collect(),
    }
}
