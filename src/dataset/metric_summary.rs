//! Metrics of maps over all materials.

use std::collections::BTreeMap;

use super::bootstrap::interval_of_mean;
use super::record::{MaterialResult, PredictionResult};
use super::summary::{Pick, median};

/// A metric of a method over the materials that it has a prediction of.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MetricSummary {
    pub mean: f64,
    pub median: f64,
    /// The 95% interval of the mean over all materials like these; `None` for fewer than 3.
    pub interval95_materials: Option<[f64; 2]>,
}

/// The metrics of `method` by name. Of several predictions of a material, those count that count for the loss.
pub fn summarize_metrics(
    method: &str,
    results: &[MaterialResult],
    pick: Pick,
) -> BTreeMap<String, MetricSummary> {
    let mut values: BTreeMap<&str, Vec<f64>> = BTreeMap::new();
    for result in results {
        let counted = counted(result, method, pick);
        for name in counted.first().map(|prediction| prediction.metrics.keys()).into_iter().flatten() {
            let all = counted.iter().filter_map(|prediction| prediction.metrics.get(name));
            values.entry(name).or_default().push(all.sum::<f64>() / counted.len() as f64);
        }
    }
    let summary = |(name, mut values): (&str, Vec<f64>)| {
        let mean = values.iter().sum::<f64>() / values.len() as f64;
        let interval95_materials = interval_of_mean(&values);
        let median = median(&mut values);
        (name.to_owned(), MetricSummary { mean, median, interval95_materials })
    };
    values.into_iter().map(summary).collect()
}

/// The predictions of a material by a method that count: those with a loss.
fn counted<'a>(result: &'a MaterialResult, method: &str, pick: Pick) -> Vec<&'a PredictionResult> {
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
