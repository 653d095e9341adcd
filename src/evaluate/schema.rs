//! JSON Schemas of the reports: the keys of their JSON with their types and meanings.

use crate::report::{
    ConformReport, DiagnoseReport, InfoReport, LossReport, MapReport, RankReport, RobustReport,
};
use schemars::Schema;
use serde_json::json;

use crate::analyses::{ANALYSES, AnyAnalysis};
use crate::dataset::DatasetReport;
use crate::json_schema::schema_of;
use crate::photograph::PhotoReport;

/// The name of a report, and its schema.
type ReportSchema = (&'static str, fn() -> Schema);

/// The schema of each other report by its name: that of its command, `dataset` for `rank --dataset`,
/// `robust` for `rank --robust`.
const OTHERS: [ReportSchema; 9] = [
    ("loss", schema_of::<LossReport>),
    ("rank", schema_of::<RankReport>),
    ("diagnose", schema_of::<DiagnoseReport>),
    ("map", schema_of::<MapReport>),
    ("photo", schema_of::<PhotoReport>),
    ("dataset", schema_of::<DatasetReport>),
    ("info", schema_of::<InfoReport>),
    ("conform", schema_of::<ConformReport>),
    ("robust", schema_of::<RobustReport>),
];

/// The names of all reports.
pub fn names() -> impl Iterator<Item = &'static str> {
    OTHERS.iter().map(|(name, _)| *name).chain(ANALYSES.iter().map(|analysis| analysis.name))
}

/// The schema of the report of this name; that of an analysis tells its words and options, too, under `x-analysis`.
pub fn named(name: &str) -> Option<Schema> {
    let Some(analysis) = AnyAnalysis::named(name) else {
        return OTHERS.iter().find(|(other, _)| *other == name).map(|(_, schema)| schema());
    };
    let AnyAnalysis { about, details, doing, scenes, schemas: [options, report], .. } = analysis;
    let options = options();
    let words =
        json!({ "about": about, "details": details, "doing": doing, "scenes": scenes, "options": options });
    let mut schema = report();
    schema.insert("x-analysis".to_owned(), words);
    Some(schema)
}
