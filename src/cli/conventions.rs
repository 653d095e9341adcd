//! `svbrdf conventions`: the named conventions, and their texts.

use svbrdf_core::model::grammar::Description;
use svbrdf_core::model::named_conventions as named;
use svbrdf_files::convention;

use super::args::comparison::names;
use super::args::offered;
use super::output::CommandError;
use super::output::exit::put_text;

/// Lists the named conventions, or prints one as TOML
///
/// A convention is everything that a rendering loss leaves open: the terms of the renderer, the grid, the scenes and the norm. A TOML
/// file of the same keys can be given wherever a convention is named.
#[derive(Debug, clap::Args)]
pub struct ConventionsArgs {
    /// Name of a convention, or a .toml file
    #[arg(value_name = "NAME", value_parser = offered(str::parse::<String>, names()), hide_possible_values = true)]
    convention: Option<String>,
}

/// Prints to stdout.
pub fn run(args: &ConventionsArgs) -> Result<(), CommandError> {
    let text = match &args.convention {
        Some(name) => convention::read(name)?.to_string(),
        None => named::all().iter().map(line).collect(),
    };
    Ok(put_text(&text)?)
}

/// The name, and what differs from `printed`.
fn line(convention: &Description) -> String {
    format!("{:24} {}\n", convention.name, named::summary(convention))
}
