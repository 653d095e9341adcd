//! Work that follows what is shown: it is computed for what is there now, and only where it is seen.

use eframe::egui;

use super::app::App;
use super::command::{
    Command, DisplayCommand, InspectCommand, LossCommand, PhotographCommand, SceneCommand, WhyCommand,
    WindowCommand,
};
use super::keys;
use super::loss_run::{Asked, LossRun};
use super::message::Message;
use super::settings::Tab;
use super::why::WhyAsked;

impl App {
    /// Takes over the results of what is shown beside the loss, and computes what is needed now.
    pub(super) fn follow_shown(&mut self, ctx: &egui::Context) {
        self.follow_few_scenes(ctx);
        let gpu = self.gpu.as_ref().map(|g| &g.gpu);
        let error = self.mixture.follow(ctx, gpu, &mut self.slots, &self.state);
        self.report(error.map(Message::Failed));
        self.seen = self.mixture.seen(&self.slots.slots, &self.state);
        let why = self.settings.tab == Tab::Why && *self.side_panel(ctx);
        self.follow_why(ctx, why);
        let error = self.scene_loss.follow(ctx, why, &self.slots, &self.state);
        self.report(error.map(Message::Failed));
        let shown = self.settings.histograms && !self.state.difference;
        let error = self.values.follow(ctx, shown, &self.seen, &self.state);
        self.report(error.map(Message::Failed));
        let shown = self.state.difference || self.viewport.shows_extra;
        let averages = shown && self.state.is_error_map();
        let gpu = self.gpu.as_ref().map(|g| &g.gpu);
        let error = self.photograph.follow(ctx, gpu, &self.seen, &self.state);
        self.report(error.map(Message::Failed));
        let of_ground_truth = shown && !averages && self.photograph_scene().is_none();
        let error = self.difference.follow(ctx, of_ground_truth, &self.seen, &self.state);
        self.report(error.map(Message::Failed));
        let gpu = self.gpu.as_ref().map(|g| &g.gpu);
        let scenes = self.settings.loss.listed_scenes();
        let error = self.error_map.follow(ctx, gpu, averages, (&self.seen, &self.state), scenes);
        self.report(error.map(Message::Failed));
        if let Some(slot) = self.slots.ground_truth() {
            self.inspect.keep_within(slot.loaded.material.size());
        }
        let error = self.region.follow(ctx, self.inspect.region, &self.seen, &self.state);
        self.report(error.map(Message::Failed));
    }

    /// The work of the tab *Why*, where it is shown. The search for the worst scene goes on in other tabs, too.
    fn follow_why(&mut self, ctx: &egui::Context, shown: bool) {
        let loss = &self.settings.loss;
        let asked = WhyAsked { sections: self.settings.why, scenes: loss.listed_scenes(), seed: loss.seed };
        // Materials that arrive one by one would be looked at in vain.
        let shown = shown && !self.slots.expects_more();
        let errors = self.why.follow(ctx, shown, &self.slots.slots, &self.state, asked);
        self.report(errors.into_iter().map(Message::Failed));
        match self.why.poll_search(ctx, &self.slots.slots, &self.state) {
            Some(Ok(worst)) => self.state.scene = worst.scene,
            Some(Err(error)) => self.report([Message::Failed(error)]),
            None => {}
        }
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

    /// The commands of the keys.
    pub(super) fn keys(&self, ctx: &egui::Context) -> Vec<Command> {
        let escape: Command = match (self.help, &self.open_window, &self.save_window) {
            _ if self.photograph_window.is_some() => PhotographCommand::ShowOpen(false).into(),
            (true, _, _) => WindowCommand::ShowHelp(false).into(),
            (_, Some(_), _) => WindowCommand::ShowOpen(false).into(),
            (_, _, Some(_)) => WindowCommand::ShowSave(false).into(),
            _ if self.study_window => LossCommand::ShowStudy(false).into(),
            _ if self.inspect.armed => InspectCommand::Arm(false).into(),
            _ if self.inspect.region.is_some() => InspectCommand::SetRegion(None).into(),
            _ if self.why.search.busy().is_some() => WhyCommand::CancelSearch.into(),
            _ if self.state.isolated.is_some() => DisplayCommand::Isolate(None).into(),
            _ => LossCommand::Cancel.into(),
        };
        let now = keys::Context {
            enter_is_free: ctx.memory(|m| m.focused()).is_none(),
            escape: &escape,
            difference: self.state.difference,
        };
        keys::commands(ctx, now)
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
