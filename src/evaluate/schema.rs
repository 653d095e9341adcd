//! JSON Schemas of the reports: the keys of their JSON with their types and meanings.

use crate::report::{ConformReport, InfoReport};
use schemars::Schema;

use crate::analyses::ANALYSES;
use crate::dataset::DatasetReport;
use crate::json_schema::schema_of;
use crate::photograph::PhotoReport;
use crate::robust::RobustReport;

/// The name of a report, and its schema.
type ReportSchema = (&'static str, fn() -> Schema);

/// The schema of each other report by its name: that of its command, `dataset` for `rank --dataset`,
/// `robust` for `rank --robust`.
const OTHERS: [ReportSchema; 5] = [
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

/// The schema of the report of this name.
pub fn named(name: &str) -> Option<Schema> {
    let of_analyses = ANALYSES.iter().map(|analysis| (analysis.name, analysis.schema));
    OTHERS.into_iter().chain(of_analyses).find(|(other, _)| *other == name).map(|(_, schema)| schema())
}
