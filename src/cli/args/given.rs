//! Options that a command line specifies; all others have their defaults.

use clap::parser::ValueSource;
use clap::{ArgMatches, Command};

use super::modes::Mode;
use super::reading::former;
use crate::cli::output::CommandError;

/// The names of the specified options of a subcommand, without dashes.
#[derive(Debug)]
pub struct Given(Vec<String>);

impl Given {
    /// Those of the subcommand of `matches`, or of `command` itself where there is none; for a former option the one that replaces it.
    pub fn of(command: &Command, matches: &ArgMatches) -> Self {
        if let Some((name, matches)) = matches.subcommand()
            && let Some(command) = command.find_subcommand(name)
        {
            return Self::of(command, matches);
        }
        let is_given = |id: &str| matches.value_source(id) == Some(ValueSource::CommandLine);
        let given = command.get_arguments().filter(|argument| is_given(argument.get_id().as_str()));
        Self(
            given
                .filter_map(|argument| argument.get_long())
                .map(former::current)
                .map(str::to_owned)
                .collect(),
        )
    }

    /// Refuses the options that a mode does not use.
    ///
    /// # Errors
    /// [`CommandError::Usage`].
    pub fn check(&self, mode: &Mode) -> Result<(), CommandError> {
        match self.0.iter().find(|option| mode.ignores(option)) {
            Some(option) => Err(CommandError::Usage(format!("{}; leave out --{option}", mode.reason))),
            None => Ok(()),
        }
    }
}
