//! Messages of the window: values here, text where they are drawn.

pub mod list;
pub mod pasted;

use std::fmt;
use std::path::{Path, PathBuf};

use svbrdf_files::Error as FilesError;
use svbrdf_files::read::ReadOptions;

use super::command::{Command, MaterialsCommand};
use super::material::problem::MaterialProblem;
use crate::error::Error;
use svbrdf_files::source::MaterialSource;

/// How much a message matters.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Severity {
    Success,
    /// A success that something can be done about.
    Offer,
    Warning,
    Error,
}

/// Something that happened and that the person should know. Its text is complete.
#[derive(Debug)]
pub enum Message {
    /// The view was written to this file.
    Saved(PathBuf),
    /// A material is not in the window, or not any more.
    Material(MaterialProblem),
    /// Something is on the clipboard.
    Copied(&'static str),
    /// The loss is over the n scenes of the file of this name.
    ScenesOpened(String, usize),
    NotPasted(PasteProblem),
    /// These were dropped on a window with materials, and are opened as predictions.
    Dropped {
        paths: Vec<PathBuf>,
        read: ReadOptions,
    },
    /// There is no session of materials from files.
    NothingToReopen,
    Failed(Error),
    /// Numbers of the settings or of a session were out of range: which, and what they are now.
    OutOfRange(String),
    /// The settings of the last start cannot be read; they were moved to this file.
    SettingsDamaged(PathBuf),
    /// The graphics device was lost, and the window continues on this adapter.
    DeviceReplaced {
        reason: String,
        adapter: String,
    },
}

/// Why the clipboard's text was not taken.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum PasteProblem {
    /// It is neither a scene nor paths of files.
    NoScene,
    /// It is a picture.
    Picture,
    /// It has a scene that cannot be rendered, for this reason.
    Unusable(String),
}

impl From<MaterialProblem> for Message {
    fn from(problem: MaterialProblem) -> Self {
        Self::Material(problem)
    }
}

impl Message {
    pub fn severity(&self) -> Severity {
        match self {
            Self::Saved(_) | Self::Copied(_) | Self::ScenesOpened(..) => Severity::Success,
            Self::Dropped { .. } => Severity::Offer,
            Self::Material(MaterialProblem::Closed(_))
            | Self::OutOfRange(_)
            | Self::SettingsDamaged(_)
            | Self::DeviceReplaced { .. } => Severity::Warning,
            Self::Material(_) | Self::NotPasted(_) | Self::NothingToReopen | Self::Failed(_) => {
                Severity::Error
            }
        }
    }

    /// What can be done about it, and the label of its button.
    pub fn remedy(&self) -> Option<(&'static str, Command)> {
        match self {
            Self::Material(MaterialProblem::Refused(sizes) | MaterialProblem::Closed(sizes)) => {
                let source = MaterialSource { fit: true, ..sizes.source.clone() };
                Some(("Fit and open", MaterialsCommand::OpenAgain(Box::new(source)).into()))
            }
            Self::Dropped { paths, read } => {
                let (paths, read) = (paths.clone(), *read);
                Some(("New comparison", MaterialsCommand::Open { paths, replace: true, read }.into()))
            }
            Self::Material(MaterialProblem::NotRead { source, error, .. }) => {
                error.names_outside()?;
                Some(allow_outside(self.path()?.to_owned(), source.options))
            }
            Self::Failed(error) => Some(allow_outside(error.names_outside()?.to_owned(), ReadOptions::AUTO)),
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

/// The question whether the file `path` may name others by absolute paths.
fn allow_outside(path: PathBuf, read: ReadOptions) -> (&'static str, Command) {
    ("Allow absolute paths", MaterialsCommand::AllowOutside { paths: vec![path], read }.into())
}

impl fmt::Display for Message {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Saved(path) => write!(f, "Saved {}", path.display()),
            Self::Failed(error) | Self::Material(MaterialProblem::NotRead { error, .. }) => {
                error.fmt(f)?;
                match error.files() {
                    Some(FilesError::Memory { .. }) => f.write_str(" (start svbrdf with --max-memory)"),
                    _ => Ok(()),
                }
            }
            Self::Material(problem) => problem.fmt(f),
            Self::NotPasted(PasteProblem::Picture) => f.write_str(
                "The clipboard holds a picture, whose encoding nothing tells. Save it as a file and open that; a copied file \
                or its path can be pasted.",
            ),
            Self::NotPasted(PasteProblem::NoScene) => f.write_str(
                "Not pasted: the clipboard holds neither a scene nor paths of files. Copy a scene from this window or \
                 from a scene file, or files of materials.",
            ),
            Self::NotPasted(PasteProblem::Unusable(problem)) => {
                write!(f, "Not pasted: the scene cannot be rendered, {problem}.")
            }
            Self::Dropped { paths, .. } => match &paths[..] {
                [_] => f.write_str("What was dropped is added as a prediction. Or look at it alone:"),
                all => write!(
                    f,
                    "The {} that were dropped are added as predictions. Or compare them with each other, the first as ground truth:",
                    all.len()
                ),
            },
            Self::NothingToReopen => f.write_str(
                "Nothing to reopen: no materials from files have been open yet. Open some with Ctrl+O.",
            ),
            Self::Copied(what) => write!(f, "Copied {what}"),
            Self::ScenesOpened(name, count) => write!(f, "The loss is over the {count} scenes of {name}"),
            Self::OutOfRange(numbers) => write!(f, "Settings out of range: {numbers}."),
            Self::DeviceReplaced { reason, adapter } => {
                write!(f, "The graphics device was lost ({reason}). The window continues on {adapter}.")
            }
            Self::SettingsDamaged(path) => write!(
                f,
                "The settings of the last start cannot be read. They are in {}; the window has the default ones.",
                path.display()
            ),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::material::problem::SizeMismatch;

    #[test]
    fn only_what_went_wrong_is_an_error() {
        let sizes = SizeMismatch {
            prediction: "small".to_owned(),
            prediction_size: [128, 64],
            ground_truth: "large".to_owned(),
            ground_truth_size: [256, 256],
            source: MaterialSource::from(PathBuf::from("small.png")),
        };
        let sizes = Box::new(sizes);
        let saved = Error::Incomplete("Saved");
        let text = "small is 128 x 64 and the ground truth large is 256 x 256";
        for (message, severity, start) in [
            (Message::Saved("a.png".into()), Severity::Success, "Saved a.png".to_owned()),
            (
                MaterialProblem::Closed(sizes.clone()).into(),
                Severity::Warning,
                format!("Prediction closed: {text}"),
            ),
            (MaterialProblem::Refused(sizes).into(), Severity::Error, format!("Not opened: {text}")),
            (Message::NotPasted(PasteProblem::NoScene), Severity::Error, "Not pasted".to_owned()),
            // A file of this name is still an error where it cannot be read.
            (Message::Failed(saved), Severity::Error, "Saved".to_owned()),
        ] {
            assert_eq!(message.severity(), severity, "{message}");
            assert!(message.to_string().starts_with(&start), "{message}");
        }
    }

    #[test]
    fn the_limit_of_memory_comes_with_its_option() {
        let error = || FilesError::Memory { what: "a.png".to_owned(), bytes: 4 << 30, limit: 1 << 30 }.into();
        let source = Box::new(MaterialSource::from(PathBuf::from("a.png")));
        let not_read = MaterialProblem::NotRead { source, error: error(), opening: 1 };
        for message in [Message::Failed(error()), not_read.into()] {
            let text = message.to_string();
            assert!(text.ends_with("or raise the limit (start svbrdf with --max-memory)"), "{text}");
        }
    }
}
