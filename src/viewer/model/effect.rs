//! Effects: what an edit of the model needs outside of it, as values. One place of the application carries them out.

use std::path::PathBuf;

use svbrdf_files::session::dataset::SessionDataset;

use crate::model::dialogs::SaveRequest;

/// What happens outside of the model: files, dialogs of the system, the clipboard.
#[derive(Clone, Debug)]
pub enum Effect {
    /// Reads scene files.
    ReadScenes(Vec<PathBuf>),
    /// Matches the materials of folders: the first has the ground truths, each other one the predictions of a method; or reads one
    /// table of pairs.
    OpenDataset(Vec<PathBuf>),
    /// Opens the data set of a session, with the losses of a results folder.
    RestoreDataset(Box<SessionDataset>, Option<PathBuf>),
    /// Asks with the system's dialog; the choice goes into the path field of the dialog that is open.
    Browse(BrowseFor),
    /// Writes a file.
    Save(SaveRequest),
    /// Puts the view on the clipboard as a picture.
    CopyPicture,
}

/// What the file dialog of the system is asked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BrowseFor {
    Files,
    Folders,
    /// A file to save.
    Saving,
}
