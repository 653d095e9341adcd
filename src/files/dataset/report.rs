//! The losses of methods over a data set as text, JSON, CSV and LaTeX.

use std::collections::BTreeMap;

use serde::{Serialize, Serializer};

use svbrdf_core::error::Error;
use svbrdf_core::report::{Cell, Report, Table, aligned, bold, escaped, latex, missed};

use super::mark_report;
use super::mark_summary::MarkSummary;
use super::metric_report;
use super::metric_summary::{MetricSummary, summarize_metrics};
use super::record::{DatasetSettings, Mark, MaterialResult, PredictionResult};
use super::summary::{MethodSummary, Pick, summarize};

const TITLES: [&str; 9] = [
    "method",
    "materials",
    "failed",
    "mean loss",
    "95% over materials",
    "95% over scenes",
    "median",
    "- best",
    "95% over materials",
];

const COLUMNS: [&str; 11] = [
    "material",
    "method",
    "sample",
    "loss",
    "standard_error",
    "interval95_low",
    "interval95_high",
    "seed",
    "scenes",
    "path",
    "error",
];

/// The columns of diagnoses.
const MARKS: [&str; 3] = ["floor", "resolvable", "marked"];

/// The results of a data set, and what they say about the methods.
#[derive(Clone, Debug)]
pub struct DatasetReport {
    pub settings: DatasetSettings,
    pub pick: Pick,
    /// Best first.
    pub methods: Vec<MethodSummary>,
    pub results: Vec<MaterialResult>,
}

impl DatasetReport {
    /// The report of `results`; of several predictions of a material, `pick` says which counts.
    pub fn new(settings: DatasetSettings, results: Vec<MaterialResult>, pick: Pick) -> Self {
        let methods = summarize(&settings.methods, &results, pick);
        Self { settings, pick, methods, results }
    }

    /// Tables for a paper: the best methods in bold, and the same of the metrics.
    pub fn latex(&self) -> String {
        let row = |summary: &MethodSummary| {
            let number = |value: f64| if value.is_nan() { "--".to_owned() } else { format!("{value:.4}") };
            let mean = bold(&number(summary.mean), summary.materials > 0 && summary.ties_with_best());
            let interval = summary
                .interval95_materials
                .map_or("--".to_owned(), |[low, high]| format!("[{low:.4}, {high:.4}]"));
            let method = escaped(&summary.method);
            format!(
                "{method} & {mean} & {interval} & {} & {} \\\\\n",
                number(summary.median),
                summary.materials
            )
        };
        let rows: String = self.methods.iter().map(row).collect();
        let losses = latex("lrlrr", "Method & Mean loss & 95\\% interval & Median & Materials", &rows);
        losses + &metric_report::latex_table(&self.methods, &self.results, self.pick)
    }

    fn losses(&self) -> String {
        let number = |value: f64| if value.is_nan() { "none".to_owned() } else { format!("{value:.6}") };
        let range = |interval: Option<[f64; 2]>| {
            interval
                .filter(|[low, _]| !low.is_nan())
                .map_or_else(|| "unknown".to_owned(), |[low, high]| format!("{low:.6} to {high:.6}"))
        };
        let mut rows = vec![TITLES.map(str::to_owned).to_vec()];
        rows.extend(self.methods.iter().map(|summary| {
            let [difference, of_difference] = match &summary.to_best {
                None => [const { String::new() }; 2],
                Some(difference) => [number(difference.mean), range(difference.interval95_materials)],
            };
            vec![
                summary.method.clone(),
                summary.materials.to_string(),
                summary.failures.to_string(),
                number(summary.mean),
                range(summary.interval95_materials),
                range(Some(summary.interval95_scenes)),
                number(summary.median),
                difference,
                of_difference,
            ]
        }));
        aligned(&rows)
    }
}

impl Report for DatasetReport {
    fn text(&self) -> String {
        let DatasetSettings { convention, target_error, seed, materials, .. } = &self.settings;
        format!(
            "rendering loss over {} of {} materials\nconvention {convention}, +-{}% per loss, seed {seed}, pick {}\n\n{}{}{}",
            self.results.len(),
            materials.len(),
            100.0 * target_error,
            self.pick,
            self.losses(),
            mark_report::text(&self.methods, &self.results, self.pick),
            metric_report::text(&self.methods, &self.results, self.pick)
        )
    }

    /// A row for each prediction.
    fn table(&self) -> Table {
        let metrics = metric_report::names(&self.results);
        let row = |result: &MaterialResult, prediction: &PredictionResult| {
            let start = [
                result.material.as_str().into(),
                prediction.method.as_str().into(),
                prediction.sample.into(),
            ];
            let numbers = match &prediction.result {
                Ok(known) => [known.loss, known.standard_error, known.interval95[0], known.interval95[1]]
                    .map(Cell::from),
                Err(_) => [const { Cell::Empty }; 4],
            };
            let end = [
                result.seed.into(),
                result.scenes.into(),
                prediction.path.as_str().into(),
                prediction.result.as_ref().err().cloned().into(),
            ];
            let metrics = metrics.iter().map(|name| prediction.metrics.get(*name).copied().into());
            let marks = self.settings.diagnose.then(|| marks(result, prediction));
            start
                .into_iter()
                .chain(numbers)
                .chain(end)
                .chain(marks.into_iter().flatten())
                .chain(metrics)
                .collect()
        };
        let of_marks = if self.settings.diagnose { &MARKS[..] } else { &[] };
        let rows = self
            .results
            .iter()
            .flat_map(|result| result.predictions.iter().map(move |prediction| (result, prediction)));
        Table::new(
            COLUMNS.into_iter().chain(of_marks.iter().copied()).chain(metrics.iter().copied()),
            rows.map(|(result, prediction)| row(result, prediction)),
        )
    }

    fn missed(&self) -> Vec<Error> {
        let of = |result: &MaterialResult, prediction: &PredictionResult| {
            let known = prediction.result.as_ref().ok()?;
            let name = format!("{}, {}", result.material, prediction.method);
            missed(self.settings.target_error, &name, &known.estimate(), result.scenes)
        };
        let all = self.results.iter();
        all.flat_map(|result| result.predictions.iter().filter_map(|p| of(result, p))).collect()
    }
}

/// The cells of [`MARKS`]: the marks are names of hypotheses, the largest share first.
fn marks(result: &MaterialResult, prediction: &PredictionResult) -> [Cell; MARKS.len()] {
    let loss = prediction.result.as_ref().ok().map(|known| known.loss);
    let resolvable = result.floor.zip(loss).map(|(floor, loss)| loss > floor);
    let names =
        |marks: &Vec<Mark>| marks.iter().map(|mark| mark.hypothesis.as_str()).collect::<Vec<_>>().join(" ");
    [result.floor.into(), resolvable.into(), prediction.marks.as_ref().map(names).into()]
}

#[derive(Serialize)]
struct DatasetJson<'a> {
    settings: &'a DatasetSettings,
    pick: String,
    /// Best first.
    methods: Vec<MethodEntry<'a>>,
    results: &'a [MaterialResult],
}

#[derive(Serialize)]
struct MethodEntry<'a> {
    method: &'a str,
    materials: usize,
    failures: usize,
    mean: f64,
    median: f64,
    interval95_materials: Option<[f64; 2]>,
    interval95_scenes: [f64; 2],
    to_best: Option<f64>,
    to_best_interval95_materials: Option<[f64; 2]>,
    ties_with_best: bool,
    /// Of the maps, by name.
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    metrics: BTreeMap<String, MetricSummary>,
    #[serde(skip_serializing_if = "Option::is_none")]
    marks: Option<MarkSummary>,
}

impl Serialize for DatasetReport {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let Self { settings, pick, methods, results } = self;
        let marks = |method: &str| mark_report::summary(method, methods, results, *pick);
        let methods = methods.iter().map(|summary| MethodEntry {
            method: &summary.method,
            materials: summary.materials,
            failures: summary.failures,
            mean: summary.mean,
            median: summary.median,
            interval95_materials: summary.interval95_materials,
            interval95_scenes: summary.interval95_scenes,
            to_best: summary.to_best.map(|difference| difference.mean),
            to_best_interval95_materials: summary
                .to_best
                .and_then(|difference| difference.interval95_materials),
            ties_with_best: summary.ties_with_best(),
            metrics: summarize_metrics(&summary.method, results, *pick),
            marks: marks(&summary.method),
        });
        DatasetJson { settings, pick: pick.to_string(), methods: methods.collect(), results }
            .serialize(serializer)
    }
}
