//! History of the model: earlier moments to return to.

use std::sync::Arc;

use eframe::egui::util::undoer::{Settings, Undoer};

use svbrdf_core::loss::FileScenes;
use svbrdf_files::photograph::SessionPhotograph;
use svbrdf_files::source::MaterialSource;

use crate::model::view::ViewState;

/// How long nothing changes, in seconds, before it becomes a moment to return to: all of a drag is one step.
const STABLE: f32 = 0.4;

/// A moment to return to.
#[derive(Clone, Debug, PartialEq)]
pub struct Moment {
    pub view: ViewState,
    pub materials: Vec<MaterialSource>,
    /// The scenes of a file, where the loss is over them.
    pub scenes: Option<FileScenes>,
    /// The photograph that renderings are compared with.
    pub photograph: Option<SessionPhotograph>,
}

/// The earlier and the later moments.
#[derive(Clone, Debug)]
pub struct History {
    pub moments: Undoer<Arc<Moment>>,
    /// The set of materials in the window, or the one that is being opened.
    pub materials: Vec<MaterialSource>,
}

impl Default for History {
    fn default() -> Self {
        let drags = Settings { stable_time: STABLE, auto_save_interval: f32::INFINITY, max_undos: 100 };
        Self { moments: Undoer::with_settings(drags), materials: Vec::new() }
    }
}
