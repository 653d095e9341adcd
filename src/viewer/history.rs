//! What undo returns to: the view, the set of materials, and the scenes of a file.

use eframe::egui::util::undoer::{Settings, Undoer};

use super::source::Source;
use super::state::ViewState;
use crate::loss::FileScenes;

/// How long nothing changes, in seconds, before it becomes a point to return to.
const STABLE: f32 = 0.4;

/// A point to return to.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Moment {
    pub view: ViewState,
    pub materials: Vec<Source>,
    /// The scenes of a file, where they are those of the loss.
    pub scenes: Option<FileScenes>,
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
