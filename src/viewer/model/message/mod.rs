//! Messages of the window: values here, text where they are drawn.

pub mod list;

use std::fmt;
use std::path::{Path, PathBuf};

use svbrdf_files::Error as FilesError;
use svbrdf_files::read::ReadOptions;
use svbrdf_files::source::MaterialSource;

use super::material::problem::MaterialProblem;
use crate::error::Error;

/// How much a message matters.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Severity {
    Success,
    Warning,
    Error,
}

/// Something that happened and that the person should know. Its text is complete.
#[derive(Debug)]
pub enum Message {
    /// Something was done: it is shown for a moment.
    Done(String),
    Warning(String),
    /// A material is not in the window, or not any more.
    Material(MaterialProblem),
    Failed(Error),
}

/// How what was refused is opened again.
#[derive(Clone, Debug, PartialEq)]
pub enum Retry {
    /// A prediction, resized to the ground truth.
    Fitted(Box<MaterialSource>),
    /// A file that may name others by absolute paths from now on.
    Outside(PathBuf, ReadOptions),
}

impl Retry {
    /// The label of its button.
    pub fn label(&self) -> &'static str {
        match self {
            Self::Fitted(_) => "Fit and open",
            Self::Outside(..) => "Allow absolute paths",
        }
    }
}

impl From<MaterialProblem> for Message {
    fn from(problem: MaterialProblem) -> Self {
        Self::Material(problem)
    }
}

impl Message {
    pub fn severity(&self) -> Severity {
        match self {
            Self::Done(_) => Severity::Success,
            Self::Warning(_) | Self::Material(MaterialProblem::Closed(_)) => Severity::Warning,
            Self::Material(_) | Self::Failed(_) => Severity::Error,
        }
    }

    /// What can be done about it.
    pub fn retry(&self) -> Option<Retry> {
        match self {
            Self::Material(MaterialProblem::Refused(sizes) | MaterialProblem::Closed(sizes)) => {
                Some(Retry::Fitted(Box::new(sizes.source.clone())))
            }
            Self::Material(MaterialProblem::NotRead { source, error, .. }) => {
                error.names_outside()?;
                Some(Retry::Outside(self.path()?.to_owned(), source.options))
            }
            Self::Failed(error) => Some(Retry::Outside(error.names_outside()?.to_owned(), ReadOptions::AUTO)),
            _ => None,
        }
    }

    /// The file that it is about: the message is settled once that has been read.
    pub fn path(&self) -> Option<&Path> {
        match self {
            Self::Material(problem) => problem.path(),
            _ => None,
        }
    }
}

impl fmt::Display for Message {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Done(text) | Self::Warning(text) => f.write_str(text),
            Self::Failed(error) | Self::Material(MaterialProblem::NotRead { error, .. }) => {
                error.fmt(f)?;
                match error.files() {
                    Some(FilesError::Memory { .. }) => f.write_str(" (start svbrdf with --max-memory)"),
                    _ => Ok(()),
                }
            }
            Self::Material(problem) => problem.fmt(f),
        }
    }
}
