//! What undo returns to: the view, the set of materials, the scenes of a file, and the photograph.

use eframe::egui::util::undoer::{Settings, Undoer};

use super::source::Source;
use super::state::ViewState;
use crate::files::session::SessionPhotograph;
use crate::loss::FileScenes;

/// How long nothing changes, in seconds, before it becomes a point to return to.
const STABLE: f32 = 0.4;

/// A point to return to.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Moment {
    pub view: ViewState,
    pub materials: Vec<Source>,
    /// The scenes of a file, where the loss is over them.
    pub scenes: Option<FileScenes>,
    /// The photograph that renderings are compared with, and its corners.
    pub photograph: Option<SessionPhotograph>,
}

/// The earlier and the later moments.
#[derive(Debug)]
pub(super) struct History {
    pub undoer: Undoer<Moment>,
    /// The set of materials in the window, or the one that is being opened.
    pub materials: Vec<Source>,
}

impl Default for History {
    fn default() -> Self {
        let settings = Settings { stable_time: STABLE, ..Settings::default() };
        Self { undoer: Undoer::with_settings(settings), materials: Vec::new() }
    }
}
