//! Effects: what a command has done outside of the model, as values. One place of the application carries them out.

use std::path::PathBuf;

use svbrdf_files::session::dataset::SessionDataset;

use super::BrowseFor;
use crate::model::dataset::OpenDataset;
use crate::model::material::request::ReadRequest;
use crate::model::settings::save_kind::{SaveKind, SaveRequest};

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
    /// Opens the data set of a session.
    RestoreDataset(Box<SessionDataset>),
    /// Reads a session file, which stands alone, and opens it.
    ReadSession(Vec<PathBuf>),
    /// Compares renderings with a photograph, or with those that a folder or a file lists.
    OpenPhotograph(PathBuf),
    /// Saves the assumptions specified for the material at this index in a sidecar file, and reads it again.
    SaveAssumptions(usize),
    Loss(LossEffect),
    Dialog(DialogEffect),
    /// Writes to a file.
    Save(SaveRequest),
    CancelSaving,
    /// Puts the view on the clipboard as a picture.
    CopyPicture,
    /// Puts a text on the clipboard; `what` names it in the message.
    CopyText {
        text: String,
        what: &'static str,
    },
    /// Puts the losses on the clipboard as text.
    CopyLosses,
    /// Puts the numbers of the pinned texels on the clipboard as CSV.
    CopyPins,
    /// Sets the size of text and controls: 1 is the size of the system.
    SetScale(f32),
}

/// An effect on the jobs of the loss and of the search for the worst scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LossEffect {
    Compute,
    Cancel,
    FindWorst,
    CancelSearch,
}

/// An effect on the dialogs.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum DialogEffect {
    ShowOpen(bool),
    /// Shows the save dialog for this kind of file; `None` closes it.
    ShowSave(Option<SaveKind>),
    /// Asks for files or folders with the dialog of the system.
    Browse(BrowseFor),
}
