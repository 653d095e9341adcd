//! Metrics of predictions beside their losses.

use std::collections::BTreeMap;

use schemars::JsonSchema;
use serde::{Serialize, Serializer};

use super::Report;
use super::heading::{Compared, scenes_line};
use super::table::{Cell, Table, aligned};
use crate::metrics::{Metric, RenderedScenes};
use svbrdf_core::loss::Sampling;

/// Metrics of maps and renderings, each with its convention in its name: docs/metrics.md defines them.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct MetricsReport {
    ground_truth: String,
    /// The convention of the renderings; `None` for those of a protocol.
    #[serde(skip_serializing_if = "Option::is_none")]
    convention: Option<&'static str>,
    /// The exposure of the renderings in stops; `None` for those of a protocol.
    #[serde(skip_serializing_if = "Option::is_none")]
    exposure_ev: Option<f32>,
    /// The published evaluation.
    #[serde(skip_serializing_if = "Option::is_none")]
    protocol: Option<&'static str>,
    /// The lines above the text's table.
    #[serde(skip)]
    heading: String,
    /// One per prediction.
    results: Vec<Metrics>,
}

/// The metrics of one prediction.
#[derive(Clone, Debug, Serialize, JsonSchema)]
struct Metrics {
    prediction: String,
    /// By name; `None` for the infinite PSNR of equal maps or renderings.
    #[serde(serialize_with = "by_name")]
    #[schemars(with = "BTreeMap<String, Option<f64>>")]
    metrics: Vec<Metric>,
    /// The 95% intervals of means over sampled scenes by name, where they are known.
    intervals95: BTreeMap<&'static str, [f64; 2]>,
}

impl MetricsReport {
    /// The metrics of maps and of renderings in `rendered`, which are of `sampling` unless they were listed. `results` are the name and
    /// the metrics of each prediction.
    pub fn new(
        compared: &Compared,
        sampling: Option<&Sampling>,
        rendered: &RenderedScenes<'_>,
        results: Vec<(String, Vec<Metric>)>,
    ) -> Self {
        let scenes = scenes_line(sampling, rendered.scenes, compared.size);
        let exposure = format!("renderings at {} EV, clipped to [0, 1]\n", rendered.exposure_ev);
        Self {
            ground_truth: compared.ground_truth.clone(),
            convention: Some(compared.convention),
            exposure_ev: Some(rendered.exposure_ev),
            protocol: None,
            heading: compared.heading("metrics") + &scenes + &exposure,
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
            exposure_ev: None,
            protocol: Some("matfusion"),
            heading,
            results: entries(results),
        }
    }

    /// The metrics of all predictions, by name.
    fn rows(&self) -> impl Iterator<Item = (&'static str, Vec<Metric>)> {
        let names = self.results.first().map(|first| first.metrics.as_slice()).unwrap_or_default();
        names.iter().enumerate().map(|(index, metric)| {
            (metric.name, self.results.iter().map(|result| result.metrics[index]).collect())
        })
    }

    /// Whether metrics are means over scenes, which may have intervals.
    fn has_scenes(&self) -> bool {
        self.protocol.is_none()
    }

    /// The titles of a table, with columns for the interval of each prediction where there may be one.
    fn columns(&self, interval: impl Fn(&str) -> Vec<String>) -> Vec<String> {
        let of = |result: &Metrics| {
            let ends = if self.has_scenes() { interval(&result.prediction) } else { Vec::new() };
            [result.prediction.clone()].into_iter().chain(ends)
        };
        ["metric".to_owned()].into_iter().chain(self.results.iter().flat_map(of)).collect()
    }

    /// The rows of a table: the name, then the cells of each prediction, the first of which is its value.
    fn cells<C, const N: usize>(
        &self,
        name: impl Fn(&str) -> C,
        cells: impl Fn(&Metric) -> [C; N],
    ) -> impl Iterator<Item = Vec<C>> {
        let used = if self.has_scenes() { N } else { 1 };
        self.rows().map(move |(metric, values)| {
            let of_all = values.iter().flat_map(|value| cells(value).into_iter().take(used));
            [name(metric)].into_iter().chain(of_all).collect()
        })
    }
}

fn entries(results: Vec<(String, Vec<Metric>)>) -> Vec<Metrics> {
    let entry = |(prediction, metrics): (String, Vec<Metric>)| {
        let known = metrics.iter().filter_map(|metric| Some((metric.name, metric.interval95?)));
        Metrics { prediction, intervals95: known.collect(), metrics }
    };
    results.into_iter().map(entry).collect()
}

fn by_name<S: Serializer>(metrics: &[Metric], serializer: S) -> Result<S::Ok, S::Error> {
    let by_name: BTreeMap<_, _> = metrics.iter().map(|metric| (metric.name, metric.value)).collect();
    by_name.serialize(serializer)
}

impl Report for MetricsReport {
    fn text(&self) -> String {
        let cells = |metric: &Metric| {
            let interval = metric.interval95.map(|[low, high]| format!("{low:.6} to {high:.6}"));
            [format!("{:.6}", metric.value), interval.unwrap_or_default()]
        };
        let titles = self.columns(|_| vec!["95%".to_owned()]);
        let rows: Vec<_> = [titles].into_iter().chain(self.cells(|name| name.to_owned(), cells)).collect();
        format!("{}\n{}", self.heading, aligned(&rows))
    }

    fn table(&self) -> Table {
        let cells = |metric: &Metric| {
            [metric.value.into(), Cell::low(metric.interval95), Cell::high(metric.interval95)]
        };
        let ends = |name: &str| ["low", "high"].map(|end| format!("{name} interval95_{end}")).into();
        Table::new(self.columns(ends), self.cells(|name| Cell::from(name), cells))
    }
}
