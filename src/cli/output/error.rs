//! Errors of a command: those of the library, of command lines that make no sense, and of results that are not good enough.

use svbrdf_core::error::Error as CoreError;
use svbrdf_evaluate::Error;
use svbrdf_files::Error as FilesError;

/// Why a command ends without success.
#[derive(Debug, thiserror::Error)]
pub enum CommandError {
    /// A command line that makes no sense, with what to do instead.
    #[error("{0}")]
    Usage(String),

    /// What was asked for is not so, which is told after what was computed is printed.
    #[error("{0}")]
    Failed(String),

    /// A material would be resized to more than fits.
    #[error("the materials cannot be resized to {width} x {height} texels: expected at most {max_side} x {max_side} \
        and {} GiB a material, found {} GiB; choose a smaller width",
        max_bytes >> 30, bytes.div_ceil(1 << 30))]
    TooLarge { width: usize, height: usize, bytes: usize, max_side: usize, max_bytes: usize },

    /// This program has no window.
    #[cfg(not(feature = "viewer"))]
    #[error(
        "cannot open a window: this program was built without the window; build with the default features"
    )]
    NoWindow,

    #[cfg(feature = "viewer")]
    #[error(transparent)]
    Window(svbrdf_viewer::Error),

    #[error(transparent)]
    Library(Error),
}

impl From<Error> for CommandError {
    fn from(error: Error) -> Self {
        if let Error::BadOption { problem, .. } = error {
            return Self::Usage(problem);
        }
        match error.core() {
            _ if matches!(error, Error::OneScene { .. }) => Self::Usage(format!("--{error}")),
            Some(CoreError::UnusedOption { option, reason }) => {
                Self::Usage(format!("{reason}; leave out --{}", option.replace('_', "-")))
            }
            _ => Self::Library(error),
        }
    }
}

impl From<FilesError> for CommandError {
    fn from(error: FilesError) -> Self {
        Error::from(error).into()
    }
}

impl From<CoreError> for CommandError {
    fn from(error: CoreError) -> Self {
        Error::from(error).into()
    }
}

#[cfg(feature = "viewer")]
impl From<svbrdf_viewer::Error> for CommandError {
    fn from(error: svbrdf_viewer::Error) -> Self {
        match error {
            svbrdf_viewer::Error::Evaluate(error) => error.into(),
            error => Self::Window(error),
        }
    }
}

impl CommandError {
    pub fn usage(problem: impl Into<String>) -> Self {
        Self::Usage(problem.into())
    }

    /// Whether there is no display, or no graphics adapter.
    pub fn is_without_graphics(&self) -> bool {
        match self {
            #[cfg(not(feature = "viewer"))]
            Self::NoWindow => true,
            #[cfg(feature = "viewer")]
            Self::Window(error) => matches!(error, svbrdf_viewer::Error::NoWindow { .. }),
            Self::Library(error) => matches!(error.core(), Some(CoreError::NoAdapter { .. })),
            _ => false,
        }
    }
}
