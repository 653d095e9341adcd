//! Messages of the window: values here, text where they are drawn.

use std::fmt;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use svbrdf_files::Error as FilesError;
use svbrdf_files::read::ReadOptions;
use svbrdf_files::source::{MaterialSource, Place};

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
    /// A prediction was not opened: its size is not the ground truth's.
    Refused(Box<SizeMismatch>),
    /// A prediction was closed: the new ground truth has another size.
    Closed(Box<SizeMismatch>),
    /// A material could not be read, in the opening of this number.
    NotRead {
        source: Box<MaterialSource>,
        error: Arc<Error>,
        opening: u64,
    },
    /// These predictions were not opened: their ground truth could not be read.
    NotOpened(Vec<String>),
    Failed(Error),
}

/// A prediction of another size than the ground truth.
#[derive(Clone, Debug, PartialEq)]
pub struct SizeMismatch {
    /// Both sizes in words.
    pub text: String,
    /// The prediction.
    pub source: MaterialSource,
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

impl Message {
    pub fn severity(&self) -> Severity {
        match self {
            Self::Done(_) => Severity::Success,
            Self::Warning(_) | Self::Closed(_) => Severity::Warning,
            Self::Refused(_) | Self::NotRead { .. } | Self::NotOpened(_) | Self::Failed(_) => Severity::Error,
        }
    }

    /// What can be done about it.
    pub fn retry(&self) -> Option<Retry> {
        match self {
            Self::Refused(sizes) | Self::Closed(sizes) => Some(Retry::Fitted(Box::new(sizes.source.clone()))),
            Self::NotRead { source, error, .. } => {
                error.names_outside()?;
                Some(Retry::Outside(self.path()?.to_owned(), source.options))
            }
            Self::Failed(error) => Some(Retry::Outside(error.names_outside()?.to_owned(), ReadOptions::AUTO)),
            _ => None,
        }
    }

    /// The file that it is about: the message is settled once that has been read.
    pub fn path(&self) -> Option<&Path> {
        let source = match self {
            Self::NotRead { source, .. } => source,
            Self::Refused(sizes) | Self::Closed(sizes) => &sizes.source,
            _ => return None,
        };
        match &source.place {
            Place::Path(path) => Some(path),
            Place::BuiltIn(_) => None,
        }
    }
}

impl fmt::Display for Message {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Done(text) | Self::Warning(text) => f.write_str(text),
            Self::Refused(sizes) => write!(f, "Not opened: {}.", sizes.text),
            Self::Closed(sizes) => write!(f, "Prediction closed: {}.", sizes.text),
            Self::NotOpened(names) => {
                write!(f, "Not opened, because the ground truth could not be read: {}.", names.join(", "))
            }
            Self::Failed(error) => failed(error, f),
            Self::NotRead { error, .. } => failed(error, f),
        }
    }
}

/// The error, with the option of the window that helps.
fn failed(error: &Error, f: &mut fmt::Formatter<'_>) -> fmt::Result {
    write!(f, "{error}")?;
    match error.files() {
        Some(FilesError::Memory { .. }) => f.write_str(" (start svbrdf with --max-memory)"),
        _ => Ok(()),
    }
}

/// How long a success is shown, in seconds.
const MOMENT: f64 = 6.0;

/// A message, and the time at which it disappears.
#[derive(Clone, Debug)]
struct Posted {
    message: Arc<Message>,
    until: Option<f64>,
}

/// The messages, the latest last.
#[derive(Clone, Debug, Default)]
pub struct MessageList {
    posted: Vec<Posted>,
}

impl MessageList {
    /// Adds a message at this time; a repeated one moves to the end.
    pub fn add(&mut self, message: Message, now: f64) {
        let text = message.to_string();
        let is_same = |earlier: &Message| earlier.path() == message.path() && earlier.to_string() == text;
        self.posted.retain(|earlier| !is_same(&earlier.message));
        let until = (message.severity() == Severity::Success).then_some(now + MOMENT);
        self.posted.push(Posted { message: Arc::new(message), until });
    }

    pub fn iter(&self) -> impl DoubleEndedIterator<Item = &Message> {
        self.posted.iter().map(|posted| &*posted.message)
    }

    /// The messages that can be dismissed, each with its number.
    pub fn lasting(&self) -> impl DoubleEndedIterator<Item = (usize, &Message)> {
        let all = self.posted.iter().enumerate();
        all.filter(|(_, posted)| posted.message.severity() != Severity::Success)
            .map(|(i, posted)| (i, &*posted.message))
    }

    /// The latest success.
    pub fn passing(&self) -> Option<&Message> {
        let is_success = |posted: &&Posted| posted.message.severity() == Severity::Success;
        self.posted.iter().rev().find(is_success).map(|posted| &*posted.message)
    }

    /// Removes what has been shown for long enough; the seconds until the next one disappears.
    pub fn expire(&mut self, now: f64) -> Option<f64> {
        self.posted.retain(|posted| posted.until.is_none_or(|until| until > now));
        self.posted.iter().filter_map(|posted| posted.until).map(|until| until - now).min_by(f64::total_cmp)
    }

    /// Removes the message of this number.
    pub fn dismiss(&mut self, number: usize) {
        if number < self.posted.len() {
            self.posted.remove(number);
        }
    }

    pub fn dismiss_all(&mut self) {
        self.posted.clear();
    }

    /// Removes the messages about a file that has been read since.
    pub fn settle(&mut self, path: &Path) {
        self.posted.retain(|posted| posted.message.path() != Some(path));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn not_read(path: &str) -> Message {
        let source = Box::new(MaterialSource::from(PathBuf::from(path)));
        let error = Arc::new(Error::internal(format!("{path} is broken")));
        Message::NotRead { source, error, opening: 1 }
    }

    #[test]
    fn a_success_disappears_and_an_error_stays_until_its_file_has_been_read() {
        let mut list = MessageList::default();
        list.add(Message::Done("Saved view.png".to_owned()), 10.0);
        list.add(not_read("a.png"), 10.0);
        list.add(not_read("b.png"), 10.0);
        assert_eq!(list.expire(12.0), Some(MOMENT - 2.0));
        assert!(list.passing().is_some() && list.lasting().count() == 2);
        assert_eq!(list.expire(17.0), None);
        assert!(list.passing().is_none() && list.lasting().count() == 2);
        list.settle(Path::new("a.png"));
        let left: Vec<_> = list.iter().map(ToString::to_string).collect();
        assert_eq!(left, [not_read("b.png").to_string()]);
    }

    #[test]
    fn a_repeated_message_moves_to_the_end() {
        let mut list = MessageList::default();
        for path in ["a.png", "b.png", "a.png"] {
            list.add(not_read(path), 0.0);
        }
        let texts: Vec<_> = list.iter().map(ToString::to_string).collect();
        assert_eq!(texts, ["b.png", "a.png"].map(|path| not_read(path).to_string()));
        list.dismiss(0);
        assert_eq!(list.iter().count(), 1);
    }
}
