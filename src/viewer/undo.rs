//! What undo returns to: the view, and the set of materials.

use eframe::egui;
use eframe::egui::util::undoer::{Settings, Undoer};

use super::app::App;
use super::source::Source;
use super::state::ViewState;

/// How long nothing changes, in seconds, before it becomes a point to return to.
const STABLE: f32 = 0.4;

/// A point to return to.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Moment {
    view: ViewState,
    materials: Vec<Source>,
}

/// The earlier and the later moments.
#[derive(Debug)]
pub(super) struct History {
    undoer: Undoer<Moment>,
    /// The set of materials in the window, or the one that is being opened.
    materials: Vec<Source>,
}

impl Default for History {
    fn default() -> Self {
        let settings = Settings { stable_time: STABLE, ..Settings::default() };
        Self { undoer: Undoer::with_settings(settings), materials: Vec::new() }
    }
}

impl App {
    /// Takes note of the moment, once the first materials are there. A set counts once it has been read.
    pub(super) fn remember_moment(&mut self, ctx: &egui::Context) {
        if self.slots.openings.is_empty() {
            self.history.materials = self.slots.sources();
        }
        if !self.history.materials.is_empty() {
            let now = self.moment();
            self.history.undoer.feed_state(ctx.input(|i| i.time), &now);
        }
    }

    pub(super) fn undo(&mut self, ctx: &egui::Context) {
        let now = self.moment();
        let earlier = self.history.undoer.undo(&now).cloned();
        self.return_to(ctx, earlier);
    }

    pub(super) fn redo(&mut self, ctx: &egui::Context) {
        let now = self.moment();
        let later = self.history.undoer.redo(&now).cloned();
        self.return_to(ctx, later);
    }

    fn moment(&self) -> Moment {
        Moment { view: self.state.clone(), materials: self.history.materials.clone() }
    }

    fn return_to(&mut self, ctx: &egui::Context, moment: Option<Moment>) {
        let Some(Moment { view, materials }) = moment else { return };
        self.state = view;
        if materials != self.history.materials {
            let gpu = self.gpu.as_ref().map(|g| &g.gpu);
            self.slots.restore(ctx, gpu, &materials);
            self.history.materials = materials;
        }
    }
}
