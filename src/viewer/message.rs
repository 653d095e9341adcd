//! What the window reports: values here, text where they are shown.

use std::fmt;
use std::path::{Path, PathBuf};

use super::command::{Command, MaterialsCommand};
use super::source::{Origin, Source};
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
    /// The view was written to this file.
    Saved(PathBuf),
    /// A prediction was not opened: its size is not the ground truth's.
    Refused(Box<SizeMismatch>),
    /// A prediction was closed: the new ground truth has another size.
    Closed(Box<SizeMismatch>),
    /// A material could not be read, in this opening.
    NotRead {
        source: Box<Source>,
        error: Error,
        opening: u64,
    },
    /// Something is on the clipboard.
    Copied(&'static str),
    /// The loss is over the n scenes of the file of this name.
    ScenesOpened(String, usize),
    /// These predictions were not opened: their ground truth could not be read.
    NotOpened(Vec<String>),
    NotPasted(PasteProblem),
    /// There is no session of materials from files.
    NothingToReopen,
    Failed(Error),
}

/// A prediction and a ground truth of different sizes.
#[derive(Clone, Debug, PartialEq)]
pub struct SizeMismatch {
    pub prediction: String,
    pub prediction_size: [usize; 2],
    pub ground_truth: String,
    pub ground_truth_size: [usize; 2],
    /// The prediction.
    pub source: Source,
}

/// Why the clipboard's text was not taken.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum PasteProblem {
    /// It is neither a scene nor paths of files.
    NoScene,
    /// It has a scene that cannot be rendered, for this reason.
    Unusable(String),
}

impl Message {
    pub fn severity(&self) -> Severity {
        match self {
            Self::Saved(_) | Self::Copied(_) | Self::ScenesOpened(..) => Severity::Success,
            Self::Closed(_) => Severity::Warning,
            Self::Refused(_)
            | Self::NotRead { .. }
            | Self::NotOpened(_)
            | Self::NotPasted(_)
            | Self::NothingToReopen
            | Self::Failed(_) => Severity::Error,
        }
    }

    /// What a person can do about it, and the label of its button.
    pub fn remedy(&self) -> Option<(&'static str, Command)> {
        match self {
            Self::Refused(sizes) | Self::Closed(sizes) => {
                let source = Source { fit: true, ..sizes.source.clone() };
                Some(("Fit and open", MaterialsCommand::OpenAgain(Box::new(source)).into()))
            }
            _ => None,
        }
    }

    /// The file that it is about: the message is settled once that has been read.
    pub fn path(&self) -> Option<&Path> {
        match self {
            Self::NotRead { source, .. } => match &source.origin {
                Origin::Path(path) => Some(path),
                Origin::BuiltIn(_) => None,
            },
            Self::Refused(sizes) | Self::Closed(sizes) => match &sizes.source.origin {
                Origin::Path(path) => Some(path),
                Origin::BuiltIn(_) => None,
            },
            _ => None,
        }
    }
}

impl fmt::Display for Message {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Saved(path) => write!(f, "Saved {}", path.display()),
            Self::Refused(sizes) => {
                write!(f, "Not opened: {sizes}.")
            }
            Self::Closed(sizes) => write!(f, "Prediction closed: {sizes}."),
            Self::NotOpened(names) => {
                write!(f, "Not opened, because the ground truth could not be read: {}.", names.join(", "))
            }
            Self::NotPasted(PasteProblem::NoScene) => f.write_str(
                "Not pasted: the clipboard holds neither a scene nor paths of files. Copy a scene from this window or \
                 from a scene file, or files of materials.",
            ),
            Self::NotPasted(PasteProblem::Unusable(problem)) => {
                write!(f, "Not pasted: the scene cannot be rendered, {problem}.")
            }
            Self::NothingToReopen => f.write_str(
                "Nothing to reopen: no materials from files have been open yet. Open some with Ctrl+O.",
            ),
            Self::Copied(what) => write!(f, "Copied {what}"),
            Self::ScenesOpened(name, count) => write!(f, "The loss is over the {count} scenes of {name}"),
            Self::NotRead { error, .. } | Self::Failed(error) => error.fmt(f),
        }
    }
}

impl fmt::Display for SizeMismatch {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [[w, h], [gt_w, gt_h]] = [self.prediction_size, self.ground_truth_size];
        write!(
            f,
            "{} is {w} x {h} and the ground truth {} is {gt_w} x {gt_h}",
            self.prediction, self.ground_truth
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::files::read::ReadOptions;

    #[test]
    fn only_what_went_wrong_is_an_error() {
        let sizes = SizeMismatch {
            prediction: "small".to_owned(),
            prediction_size: [128, 64],
            ground_truth: "large".to_owned(),
            ground_truth_size: [256, 256],
            source: Source::file("small.png".into(), ReadOptions::AUTO),
        };
        let sizes = Box::new(sizes);
        let saved = Error::AboveLimit { name: "Saved".to_owned(), loss: 2.0, limit: 1.0 };
        let text = "small is 128 x 64 and the ground truth large is 256 x 256";
        for (message, severity, start) in [
            (Message::Saved("a.png".into()), Severity::Success, "Saved a.png".to_owned()),
            (Message::Closed(sizes.clone()), Severity::Warning, format!("Prediction closed: {text}")),
            (Message::Refused(sizes), Severity::Error, format!("Not opened: {text}")),
            (Message::NotPasted(PasteProblem::NoScene), Severity::Error, "Not pasted".to_owned()),
            // A file of this name is still an error where it cannot be read.
            (Message::Failed(saved), Severity::Error, "Saved".to_owned()),
        ] {
            assert_eq!(message.severity(), severity, "{message}");
            assert!(message.to_string().starts_with(&start), "{message}");
        }
    }
}
