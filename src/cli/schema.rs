//! `svbrdf schema`: the JSON Schema of a report.

use std::collections::BTreeMap;

use clap::builder::PossibleValuesParser;

use svbrdf_evaluate::schema::REPORTS;

use super::output::exit::put;
use super::output::{CommandError, json};

/// Prints the JSON Schema of a report: the keys of its JSON with their types and meanings
///
/// Reports have the names of their commands; `capture` is that of `photo --capture`, `dataset` that of `rank --dataset`, and `map` that of
/// svbrdf.map in Python. Without a name: an object of all of them.
#[derive(Debug, clap::Args)]
#[command(after_help = "Example:\n  svbrdf schema loss")]
pub struct SchemaArgs {
    /// Name of the report
    #[arg(value_name = "NAME", value_parser = PossibleValuesParser::new(REPORTS.map(|(name, _)| name)))]
    report: Option<String>,
}

/// Prints the schema to stdout.
///
/// # Errors
/// Where stdout cannot be written.
pub fn run(args: &SchemaArgs) -> Result<(), CommandError> {
    let is_wanted = |name: &str| args.report.as_deref().is_none_or(|wanted| wanted == name);
    let found = REPORTS.into_iter().filter(|(name, _)| is_wanted(name));
    let mut found: BTreeMap<_, _> = found.map(|(name, schema)| (name, schema())).collect();
    let text = match args.report.as_deref().and_then(|name| found.remove(name)) {
        Some(one) => json::text(&one),
        None => json::text(&found),
    };
    Ok(put(&text?)?)
}
