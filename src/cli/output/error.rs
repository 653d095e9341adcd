//! Errors of a command: those of the library, and command lines that make no sense.

use svbrdf_core::error::Error;

/// Why a command ends without success.
#[derive(Debug, thiserror::Error)]
pub enum CommandError {
    /// A command line that makes no sense, with what to do instead.
    #[error("{0}")]
    Usage(String),
    #[error(transparent)]
    Library(#[from] Error),
}

impl CommandError {
    pub fn usage(problem: impl Into<String>) -> Self {
        Self::Usage(problem.into())
    }
}
