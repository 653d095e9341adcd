//! Errors of a command: those of the library, and command lines that make no sense.

use svbrdf_core::error::Error;

/// Why a command ends without success.
#[derive(Debug, thiserror::Error)]
pub enum CommandError {
    /// A command line that makes no sense, with what to do instead.
    #[error("{0}")]
    Usage(String),
    #[error(transparent)]
    Library(Error),
}

impl From<Error> for CommandError {
    fn from(error: Error) -> Self {
        match error {
            Error::UnusedOption { option, reason } => {
                Self::Usage(format!("{reason}; leave out --{}", option.replace('_', "-")))
            }
            error => Self::Library(error),
        }
    }
}

impl CommandError {
    pub fn usage(problem: impl Into<String>) -> Self {
        Self::Usage(problem.into())
    }
}
