//! JSON Schemas of the reports: the keys of their JSON with their types and meanings.

use crate::report::{DiagnoseReport, InfoReport, LossReport, MapReport, RankReport};
use schemars::generate::SchemaSettings;
use schemars::transform::RecursiveTransform;
use schemars::{JsonSchema, Schema};
use serde_json::{Value, json};

use crate::analysis::{ANALYSES, AnyAnalysis};
use crate::dataset::DatasetReport;
use crate::photograph::PhotoReport;

/// The schema of each other report by its name: that of its command, `dataset` for `rank --dataset`.
const OTHERS: [(&str, fn() -> Schema); 7] = [
    ("loss", of::<LossReport>),
    ("rank", of::<RankReport>),
    ("diagnose", of::<DiagnoseReport>),
    ("map", of::<MapReport>),
    ("photo", of::<PhotoReport>),
    ("dataset", of::<DatasetReport>),
    ("info", of::<InfoReport>),
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
    let AnyAnalysis { about, details, doing, scenes, options, .. } = analysis;
    let options = options();
    let words =
        json!({ "about": about, "details": details, "doing": doing, "scenes": scenes, "options": options });
    let mut schema = (analysis.report)();
    schema.insert("x-analysis".to_owned(), words);
    Some(schema)
}

/// The schema of what is written, not of what could be read.
pub(crate) fn of<T: JsonSchema>() -> Schema {
    let settings = SchemaSettings::draft2020_12().for_serialize();
    settings.with_transform(RecursiveTransform(reworded)).into_generator().into_root_schema_for::<T>()
}

/// A doc comment for readers of JSON: on one line, with null in place of `None`.
fn reworded(schema: &mut Schema) {
    if let Some(Value::String(text)) = schema.get_mut("description") {
        *text = text.replace('\n', " ").replace("`None`", "null").replace("[`", "`").replace("`]", "`");
    }
}
