//! Undo and redo.

use eframe::egui;

use crate::viewer::app::App;
use crate::viewer::history::Moment;

impl App {
    /// Takes note of the moment, once the first materials are there. A set counts once it has been read.
    pub(in crate::viewer) fn remember_moment(&mut self, ctx: &egui::Context) {
        if self.slots.openings.is_empty() {
            let materials = self.slots.sources();
            if materials != self.history.materials {
                self.history.materials = materials;
                self.remember_session();
            }
        }
        // A photograph counts once it has been read, too.
        if !self.history.materials.is_empty() && self.photograph.is_settled() {
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
        let scenes = self.settings.loss.file_scenes().cloned();
        let photograph = self.photograph.source().cloned();
        Moment { view: self.state.clone(), materials: self.history.materials.clone(), scenes, photograph }
    }

    fn return_to(&mut self, ctx: &egui::Context, moment: Option<Moment>) {
        let Some(Moment { view, materials, scenes, photograph }) = moment else { return };
        self.state = view;
        if scenes.as_ref() != self.settings.loss.file_scenes() {
            self.settings.loss = self.settings.loss.with_file(scenes);
        }
        if photograph.as_ref() != self.photograph.source() {
            self.photograph.set(photograph);
        }
        if materials != self.history.materials {
            let gpu = self.gpu.as_ref().map(|g| &g.gpu);
            self.slots.restore(ctx, gpu, &materials);
            self.history.materials = materials;
        }
    }
}
