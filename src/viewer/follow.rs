//! Work that follows what is shown: it is computed for what is there now, and only where it is seen.

use eframe::egui;

use super::app::App;
use super::command::{Command, SceneCommand};
use super::loss_run::{Asked, LossRun};
use super::message::Message;
use super::settings::Tab;

impl App {
    /// Takes over the results of what is shown beside the loss, and computes what is needed now.
    pub(super) fn follow_shown(&mut self, ctx: &egui::Context) {
        self.follow_few_scenes(ctx);
        let why = self.settings.tab == Tab::Why && *self.side_panel(ctx);
        let error = self.scene_loss.follow(ctx, why, &self.slots, &self.state);
        self.report(error.map(Message::Failed));
        let shown = self.settings.histograms && !self.state.difference;
        let error = self.values.follow(ctx, shown, &self.slots, &self.state);
        self.report(error.map(Message::Failed));
        let shown = self.state.difference || self.viewport.shows_extra;
        let error = self.difference.follow(ctx, shown, &self.slots, &self.state);
        self.report(error.map(Message::Failed));
        if let Some(slot) = self.slots.ground_truth() {
            self.inspect.keep_within(slot.loaded.material.size());
        }
        let error = self.region.follow(ctx, self.inspect.region, &self.slots, &self.state);
        self.report(error.map(Message::Failed));
    }

    /// Computes the loss over the few scenes of the papers, where the loss is another one and is done.
    fn follow_few_scenes(&mut self, ctx: &egui::Context) {
        let Asked { request, convention } = self.asked();
        let few = self.settings.loss.few_scenes();
        if request == few {
            self.few = LossRun::default();
            return;
        }
        let asked = Asked { request: few, convention };
        let done = !self.loss.is_running() && self.loss.losses().is_some();
        self.few.follow(ctx, &self.slots, &asked, self.settings.auto_loss && done);
        self.few.poll(ctx);
    }

    /// Space, pressed and released without a drag, pauses what moves by itself.
    pub(super) fn pause_key(&mut self, ctx: &egui::Context) -> Option<Command> {
        let (pressed, released, down, dragging) = ctx.input(|i| {
            let space = egui::Key::Space;
            (i.key_pressed(space), i.key_released(space), i.key_down(space), i.pointer.any_down())
        });
        if pressed {
            self.space_dragged = false;
        }
        self.space_dragged |= down && dragging;
        let moves = self.animation.light || self.animation.turntable;
        let free = ctx.memory(|m| m.focused()).is_none();
        (released && !self.space_dragged && moves && free).then_some(SceneCommand::TogglePause.into())
    }
}
