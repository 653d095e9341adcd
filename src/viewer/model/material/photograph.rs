//! Photograph of the window: which one is open, and whether its corners are edited.

use svbrdf_files::disk::stamp::Stamp;
use svbrdf_files::photograph::SessionPhotograph;

/// The photograph that renderings are compared with.
#[derive(Debug, Default)]
pub struct PhotographState {
    source: Option<SessionPhotograph>,
    /// Of its file when it was opened: a file that has changed since is another photograph.
    stamp: Option<Stamp>,
    edits_corners: bool,
}

impl PhotographState {
    /// Opens another photograph, whose file has this stamp, or closes the one that is open.
    pub fn set(&mut self, source: Option<SessionPhotograph>, stamp: Option<Stamp>) {
        self.source = source;
        self.stamp = stamp;
        self.edits_corners &= self.source.is_some();
    }

    /// The photograph that is open.
    pub fn source(&self) -> Option<&SessionPhotograph> {
        self.source.as_ref()
    }

    /// The photograph that is open, to change how it is used.
    pub fn source_mut(&mut self) -> Option<&mut SessionPhotograph> {
        self.source.as_mut()
    }

    /// The stamp of its file when it was opened.
    pub fn stamp(&self) -> Option<Stamp> {
        self.stamp
    }

    /// Starts or ends to edit the corners.
    pub fn edit_corners(&mut self, on: bool) {
        self.edits_corners = on && self.source.is_some();
    }

    /// Whether the corners are edited: the pane of the photograph then shows it as it was taken.
    pub fn edits_corners(&self) -> bool {
        self.edits_corners
    }
}
