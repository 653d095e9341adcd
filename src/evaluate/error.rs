//! Errors of analyses.

use svbrdf_core::error::Error as CoreError;
use svbrdf_core::text::percent;
use svbrdf_files::Error as FilesError;

/// The error of every fallible operation of this crate.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// No factor brings a photograph to the exposure of a rendering.
    #[error(
        "the exposure of the photograph cannot be fitted to {name}: {problem}; check light and view, or take \
        another photograph"
    )]
    NoExposure { name: String, problem: String },

    /// The materials of a study do not differ.
    #[error(
        "the two materials look the same in every scene, so that there is no error to study; \
        give a prediction that differs from the ground truth"
    )]
    NothingToStudy,

    /// The search for a worst scene has no distances left.
    #[error("a distance tail of {}, at either end, leaves no distances; give less than 50%, such as 0.5%", percent(*found))]
    DistanceTail { found: f64 },

    /// There is nothing to compare a ground truth with.
    #[error("there is no prediction to compare; open one")]
    NoPrediction,

    /// A ranking in one scene of a kind.
    #[error("{option}: one scene of a kind has no error; give 0, or 2 or more")]
    OneScene {
        /// `near` or `distant`.
        option: &'static str,
    },

    /// An option of an unknown name, a wrong type or an impossible value.
    #[error("{name}: {problem}")]
    BadOption { name: String, problem: String },

    /// A protocol that says something impossible.
    #[error("the protocol {name}: {problem}; correct it, docs/protocols.md has the format")]
    BadProtocol {
        /// Its name or its file.
        name: String,
        problem: String,
    },

    /// There is no mask, or it is of another material.
    #[error("the mask: {problem}; leave out --mask, or give another picture")]
    NoMask { problem: String },

    /// Of a file, or of a computation.
    #[error(transparent)]
    Files(#[from] FilesError),
}

impl From<CoreError> for Error {
    fn from(error: CoreError) -> Self {
        Self::Files(error.into())
    }
}

impl Error {
    /// The error of a file, where it is one.
    pub fn files(&self) -> Option<&FilesError> {
        match self {
            Self::Files(error) => Some(error),
            _ => None,
        }
    }

    /// The error of a computation, where it is one.
    pub fn core(&self) -> Option<&CoreError> {
        self.files().and_then(FilesError::core)
    }

    /// Whether the caller cancelled the work.
    pub fn is_cancelled(&self) -> bool {
        self.files().is_some_and(FilesError::is_cancelled)
    }
}
