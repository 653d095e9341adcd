//! `svbrdf schema`: the JSON Schema of a report.

use std::collections::BTreeMap;

use clap::builder::PossibleValuesParser;

use svbrdf_evaluate::schema;

use super::output::exit::put;
use super::output::{CommandError, json};

/// Prints the JSON Schema of a report: the keys of its JSON with their types and meanings
///
/// Reports have the names of their commands; `dataset` is that of `rank --dataset`, and `map` that of svbrdf.map in Python. Without a name: an object of all of them.
#[derive(Debug, clap::Args)]
pub struct SchemaArgs {
    /// Name of the report
    #[arg(value_name = "NAME", value_parser = PossibleValuesParser::new(schema::names()))]
    report: Option<String>,
}

/// Prints the schema to stdout.
pub fn run(args: &SchemaArgs) -> Result<(), CommandError> {
    let text = match args.report.as_deref().and_then(schema::named) {
        Some(one) => json::text(&one),
        None => {
            json::text(&schema::names().map(|name| (name, schema::named(name))).collect::<BTreeMap<_, _>>())
        }
    };
    Ok(put(&text?)?)
}
