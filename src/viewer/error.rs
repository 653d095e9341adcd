//! Errors of the window.

use std::path::Path;

use svbrdf_core::error::Error as CoreError;
use svbrdf_evaluate::Error as EvaluateError;
use svbrdf_files::Error as FilesError;

/// The error of every fallible operation of this crate.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// No window can be opened.
    #[error("cannot open a window: {problem}; {remedy}")]
    NoWindow { problem: String, remedy: &'static str },

    /// A result is saved before it has been computed.
    #[error("{0} is not complete yet: save it once it is displayed")]
    Incomplete(&'static str),

    /// What is not computed over the texels of a mask, in words.
    #[error("{0}")]
    Masked(&'static str),

    /// Of an analysis, a file or a computation.
    #[error(transparent)]
    Evaluate(#[from] EvaluateError),
}

impl From<FilesError> for Error {
    fn from(error: FilesError) -> Self {
        Self::Evaluate(error.into())
    }
}

impl From<CoreError> for Error {
    fn from(error: CoreError) -> Self {
        Self::Evaluate(error.into())
    }
}

impl Error {
    /// A defect of this program.
    pub(crate) fn internal(problem: impl Into<String>) -> Self {
        FilesError::Internal(problem.into()).into()
    }

    /// The error of a file, where it is one.
    pub fn files(&self) -> Option<&FilesError> {
        match self {
            Self::Evaluate(error) => error.files(),
            _ => None,
        }
    }

    /// The file that names another by an absolute path, which the user may allow.
    pub fn names_outside(&self) -> Option<&Path> {
        match self.files() {
            Some(FilesError::Outside { by, .. }) => Some(by),
            _ => None,
        }
    }

    /// Whether the caller cancelled the work.
    pub fn is_cancelled(&self) -> bool {
        self.files().is_some_and(FilesError::is_cancelled)
    }
}
