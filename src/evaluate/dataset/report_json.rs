//! The losses of methods over a data set as JSON.

use std::borrow::Cow;
use std::collections::BTreeMap;

use schemars::{JsonSchema, Schema, SchemaGenerator};
use serde::{Serialize, Serializer};

use super::doubts::ReadingSummary;
use super::mark_summary::{MarkSummary, summarize_marks};
use super::metric_summary::{MetricSummary, summarize_metrics};
use super::ranking::DatasetReport;
use super::record::{DatasetReading, DatasetSettings, MaterialResult};
use svbrdf_files::disk::atomic::SOFTWARE;

/// The losses of methods over a data set.
#[derive(Serialize, JsonSchema)]
#[schemars(rename = "DatasetReport")]
struct DatasetJson<'a> {
    #[schemars(with = "BTreeMap<String, serde_json::Value>")]
    settings: &'a DatasetSettings,
    /// How the files are read.
    #[schemars(with = "BTreeMap<String, serde_json::Value>")]
    reading: &'a DatasetReading,
    pick: String,
    /// The program and its version.
    software: &'static str,
    /// The command that makes the results again.
    command: String,
    /// The names of the materials that the means of compared methods are over.
    compared_materials: Vec<&'a str>,
    /// How the ground truths were read.
    ground_truths: ReadingSummary,
    /// The compared ones first, best first.
    methods: Vec<MethodEntry<'a>>,
    results: &'a [MaterialResult],
}

/// The losses of a method.
#[derive(Serialize, JsonSchema)]
#[schemars(rename = "MethodSummary")]
struct MethodEntry<'a> {
    method: &'a str,
    /// Whether it has a loss of as many materials as any other; if not, its mean is over other materials.
    compared: bool,
    /// The number of materials with a loss.
    materials: usize,
    /// The number of materials without one.
    failures: usize,
    /// Over the materials that all compared methods have, `compared_materials`; `None` without a loss.
    #[schemars(with = "Option<f64>")]
    mean: f64,
    #[schemars(with = "Option<f64>")]
    median: f64,
    /// The 95% interval of the mean over all materials like these; `None` for fewer than 5.
    interval95_materials: Option<[f64; 2]>,
    /// The 95% interval of the mean over these materials, due to the sampling of scenes alone.
    #[schemars(with = "[Option<f64>; 2]")]
    interval95_scenes: [f64; 2],
    /// The mean difference to the best method over the materials of both; `None` for the best.
    to_best: Option<f64>,
    to_best_interval95_materials: Option<[f64; 2]>,
    /// Whether it is compared, and the materials cannot separate it from the best.
    ties_with_best: bool,
    /// How its predictions were read; `None` where there are none.
    reading: Option<ReadingSummary>,
    /// Of the maps, by name; `None` where they were not asked for.
    #[schemars(with = "Option<BTreeMap<String, MetricSummary>>")]
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    metrics: BTreeMap<String, MetricSummary>,
    /// `None` where no diagnosis was asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    marks: Option<MarkSummary>,
}

impl JsonSchema for DatasetReport {
    fn schema_name() -> Cow<'static, str> {
        DatasetJson::schema_name()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        DatasetJson::json_schema(generator)
    }
}

impl Serialize for DatasetReport {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let Self { settings, reading, pick, ranking, results } = self;
        let mut readings = ReadingSummary::by_method(results);
        let methods = ranking.methods.iter().map(|summary| MethodEntry {
            method: &summary.method,
            compared: summary.is_compared,
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
            reading: readings.remove(summary.method.as_str()),
            metrics: summarize_metrics(self, summary),
            marks: summarize_marks(self, summary),
        });
        let is_common = |result: &&MaterialResult| ranking.common.contains(&result.index);
        DatasetJson {
            settings,
            reading,
            pick: pick.to_string(),
            software: SOFTWARE,
            command: self.command(),
            compared_materials: results.iter().filter(is_common).map(|one| one.material.as_str()).collect(),
            ground_truths: ReadingSummary::of_ground_truths(results),
            methods: methods.collect(),
            results,
        }
        .serialize(serializer)
    }
}
