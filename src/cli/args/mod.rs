//! Arguments that several subcommands share, their values, and the refusal of options that a mode of a subcommand does not use.

pub mod comparison;
pub mod named_path;
pub mod offered;
pub mod protocol;
pub mod reading;
pub mod scenes;
pub mod trust;
pub mod values;
pub mod wildcards;

pub use comparison::{ComparisonArgs, MaterialArgs};
pub use named_path::{NamedPath, is_there};
pub use offered::offered;
pub use trust::TrustArgs;

use crate::cli::output::CommandError;
use clap::parser::ValueSource;
use clap::{ArgMatches, Command};

/// The names of the specified arguments of a subcommand.
#[derive(Debug)]
pub struct Specified(Vec<String>);

impl Specified {
    /// Those of the subcommand of `matches`, or of `matches` itself where there is none.
    pub fn of(matches: &ArgMatches) -> Self {
        let matches = matches.subcommand().map_or(matches, |(_, matches)| matches);
        let is_given = |id: &&clap::Id| matches.value_source(id.as_str()) == Some(ValueSource::CommandLine);
        Self(matches.ids().filter(is_given).map(|id| id.as_str().to_owned()).collect())
    }

    /// Refuses the options of `A`, which the mode of a command does not use.
    pub fn refuse<A: clap::Args>(&self, reason: &str) -> Result<(), CommandError> {
        let unused = A::augment_args(Command::new("unused"));
        let mut unused =
            unused.get_arguments().filter(|unused| self.0.iter().any(|id| unused.get_id() == id));
        let option = unused.find_map(|unused| unused.get_long());
        refuse(option.is_some(), option.unwrap_or_default(), reason)
    }
}

/// Refuses an option that the mode of a command does not use, where it is specified.
pub fn refuse(is_specified: bool, option: &str, reason: &str) -> Result<(), CommandError> {
    if is_specified { Err(CommandError::Usage(format!("{reason}; leave out --{option}"))) } else { Ok(()) }
}
