//! Metrics of predictions beside their losses.

use std::collections::BTreeMap;

use serde::{Serialize, Serializer};

use super::Report;
use super::heading::{Compared, scenes_line};
use super::table::{Cell, Table, aligned};
use crate::loss::Sampling;
use crate::metrics::Metric;
use crate::model::scene::Scene;

/// The metrics of each prediction.
#[derive(Clone, Debug, Serialize)]
pub struct MetricsReport {
    ground_truth: String,
    /// The convention of the renderings.
    #[serde(skip_serializing_if = "Option::is_none")]
    convention: Option<&'static str>,
    /// The published evaluation.
    #[serde(skip_serializing_if = "Option::is_none")]
    protocol: Option<&'static str>,
    /// The lines above the text's table.
    #[serde(skip)]
    heading: String,
    results: Vec<MetricsEntry>,
}

#[derive(Clone, Debug, Serialize)]
struct MetricsEntry {
    prediction: String,
    /// Without an order of its own; an infinite PSNR, of equal renderings, is null in JSON.
    #[serde(serialize_with = "by_name")]
    metrics: Vec<Metric>,
}

impl MetricsReport {
    /// The metrics of maps and of renderings in `scenes`, which are of `sampling` unless they were listed. `results` are the name and
    /// the metrics of each prediction.
    pub fn new(
        compared: &Compared,
        sampling: Option<&Sampling>,
        scenes: &[Scene],
        results: Vec<(String, Vec<Metric>)>,
    ) -> Self {
        Self {
            ground_truth: compared.ground_truth.clone(),
            convention: Some(compared.convention),
            protocol: None,
            heading: compared.heading("metrics") + &scenes_line(sampling, scenes, compared.size),
            results: entries(results),
        }
    }

    /// The metrics of MatFusion's evaluation against a ground truth of `size` (width, height).
    pub fn matfusion(
        ground_truth: &str,
        [width, height]: [usize; 2],
        results: Vec<(String, Vec<Metric>)>,
    ) -> Self {
        let heading =
            format!("metrics of MatFusion's score.py against {ground_truth}, {width} x {height} texels\n");
        Self {
            ground_truth: ground_truth.to_owned(),
            convention: None,
            protocol: Some("matfusion"),
            heading,
            results: entries(results),
        }
    }

    /// The value of each prediction for each metric.
    fn rows(&self) -> impl Iterator<Item = (&'static str, Vec<f64>)> {
        let names = self.results.first().map(|first| first.metrics.as_slice()).unwrap_or_default();
        names.iter().enumerate().map(|(index, metric)| {
            (metric.name, self.results.iter().map(|result| result.metrics[index].value).collect())
        })
    }

    fn columns(&self) -> Vec<String> {
        let names = self.results.iter().map(|result| result.prediction.clone());
        ["metric".to_owned()].into_iter().chain(names).collect()
    }
}

fn entries(results: Vec<(String, Vec<Metric>)>) -> Vec<MetricsEntry> {
    results.into_iter().map(|(prediction, metrics)| MetricsEntry { prediction, metrics }).collect()
}

fn by_name<S: Serializer>(metrics: &[Metric], serializer: S) -> Result<S::Ok, S::Error> {
    let by_name: BTreeMap<_, _> = metrics.iter().map(|metric| (metric.name, metric.value)).collect();
    by_name.serialize(serializer)
}

impl Report for MetricsReport {
    fn text(&self) -> String {
        let row = |(name, values): (&str, Vec<f64>)| {
            let values = values.into_iter().map(|value| format!("{value:.6}"));
            [name.to_owned()].into_iter().chain(values).collect()
        };
        let rows: Vec<_> = [self.columns()].into_iter().chain(self.rows().map(row)).collect();
        format!("{}\n{}", self.heading, aligned(&rows))
    }

    fn table(&self) -> Table {
        let row = |(name, values): (&str, Vec<f64>)| {
            [name.into()].into_iter().chain(values.into_iter().map(Cell::from)).collect()
        };
        Table::new(self.columns(), self.rows().map(row))
    }
}
