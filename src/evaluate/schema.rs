//! JSON Schemas of the reports: the keys of their JSON with their types and meanings.

use crate::report::{
    BlameReport, DiagnoseReport, InfoReport, LossReport, MapReport, MetricsReport, RankReport, ScenesReport,
    WorstReport,
};
use schemars::generate::SchemaSettings;
use schemars::transform::RecursiveTransform;
use schemars::{JsonSchema, Schema};
use serde_json::Value;

use crate::dataset::DatasetReport;
use crate::photograph::PhotoReport;

/// The name of a report, and its schema.
pub type ReportSchema = (&'static str, fn() -> Schema);

/// The schema of each report by its name: that of its command, `dataset` for `rank --dataset`.
pub const REPORTS: [ReportSchema; 11] = [
    ("loss", of::<LossReport>),
    ("rank", of::<RankReport>),
    ("blame", of::<BlameReport>),
    ("diagnose", of::<DiagnoseReport>),
    ("scenes", of::<ScenesReport>),
    ("worst", of::<WorstReport>),
    ("map", of::<MapReport>),
    ("metrics", of::<MetricsReport>),
    ("photo", of::<PhotoReport>),
    ("dataset", of::<DatasetReport>),
    ("info", of::<InfoReport>),
];

/// The schema of what is written, not of what could be read.
fn of<T: JsonSchema>() -> Schema {
    let settings = SchemaSettings::draft2020_12().for_serialize();
    settings.with_transform(RecursiveTransform(reworded)).into_generator().into_root_schema_for::<T>()
}

/// A doc comment for readers of JSON: on one line, with null in place of `None`.
fn reworded(schema: &mut Schema) {
    if let Some(Value::String(text)) = schema.get_mut("description") {
        *text = text.replace('\n', " ").replace("`None`", "null").replace("[`", "`").replace("`]", "`");
    }
}
