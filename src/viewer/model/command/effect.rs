//! Effects: what a command has done outside of the model, as values. One place of the application carries them out.

use std::path::PathBuf;

use svbrdf_files::session::dataset::SessionDataset;

use super::{LossCommand, WhyCommand, WindowCommand};
use crate::model::dataset::OpenDataset;
use crate::model::material::request::ReadRequest;

/// One effect of a command.
#[derive(Clone, Debug)]
pub enum Effect {
    /// Reads materials.
    Read(ReadRequest),
    /// Reads the materials that the open dialog has asked for, which stays open until they are there.
    ReadForDialog(ReadRequest),
    /// Cancels the opening of this number.
    CancelReading(u64),
    /// Lets files name others by absolute paths from now on.
    AllowOutside,
    /// Reads a convention.
    ReadConvention(PathBuf),
    /// Reads scene files.
    ReadScenes(Vec<PathBuf>),
    /// Matches the materials of folders, or reads a table of pairs.
    OpenDataset(Vec<PathBuf>),
    /// Opens a list of predictions of one ground truth.
    OpenMany(Box<OpenDataset>),
    /// Reads a material of the data set and its losses again.
    ReadCaseAgain(usize),
    /// Opens the data set of a session, with the losses of a results folder.
    RestoreDataset(Box<SessionDataset>, Option<PathBuf>),
    /// Reads a session file, which stands alone, and opens it.
    ReadSession(Vec<PathBuf>),
    /// Compares renderings with a photograph, or with those that a folder or a file lists.
    OpenPhotograph(PathBuf),
    /// Saves the assumptions specified for the material at this index in a sidecar file, and reads it again.
    SaveAssumptions(usize),
    /// What these commands do is all outside of the model.
    Loss(LossCommand),
    Why(WhyCommand),
    Window(WindowCommand),
    /// Puts a text on the clipboard; `what` names it in the message.
    CopyText {
        text: String,
        what: &'static str,
    },
}
