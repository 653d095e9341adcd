//! Repetition of a result: the command that makes it again, and the version of the program.

use std::fmt;

use serde::Serialize;

use svbrdf_files::disk::atomic::SOFTWARE;

/// How to repeat a result.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Repetition {
    /// The program and its version.
    pub software: &'static str,
    /// The command line.
    pub command: String,
}

impl Repetition {
    /// By `command` and this version of the program.
    pub fn new(command: String) -> Self {
        Self { software: SOFTWARE, command }
    }
}

impl fmt::Display for Repetition {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "repeat with {}: {}", self.software, self.command)
    }
}
