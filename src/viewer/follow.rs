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
use super::work_context::WorkContext;
use crate::error::Error;
use crate::loss::Request;

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
        if let Some(slot) = self.slots.ground_truth() {
            self.inspect.keep_within(slot.loaded.material.size());
        }
        let errors = self.follow_panes(ctx);
        self.report(errors.into_iter().map(Message::Failed));
    }

    /// The work on what the panes show.
    fn follow_panes(&mut self, ctx: &egui::Context) -> Vec<Error> {
        let histograms = self.settings.histograms && !self.state.difference;
        let differences = self.state.difference || self.viewport.shows_extra;
        let averages = differences && self.state.is_error_map();
        let scenes = self.settings.loss.listed_scenes();
        let gpu = self.gpu.as_ref().map(|g| &g.gpu);
        let work = WorkContext { ctx, gpu, slots: &self.seen, state: &self.state };
        let mut errors =
            vec![self.values.follow(&work, histograms), self.region.follow(&work, self.inspect.region)];
        errors.push(self.photograph.follow(&work));
        let of_ground_truth = differences && !averages && self.photograph_scene().is_none();
        errors.push(self.difference.follow(&work, of_ground_truth));
        errors.push(self.error_map.follow(&work, averages, scenes));
        errors.into_iter().flatten().collect()
    }

    /// The work of the tab *Why*, where it is shown. The search for the worst scene goes on in other tabs, too.
    fn follow_why(&mut self, ctx: &egui::Context, shown: bool) {
        let loss = &self.settings.loss;
        let asked = WhyAsked { sections: self.settings.why, scenes: loss.listed_scenes(), seed: loss.seed };
        // Materials that arrive one by one would be looked at in vain.
        let complete = !self.slots.expects_more();
        let gpu = self.gpu.as_ref().map(|g| &g.gpu);
        let work = WorkContext { ctx, gpu, slots: &self.slots.slots, state: &self.state };
        let mut errors = self.why.follow(&work, shown && complete, asked);
        errors.extend(self.scene_loss.follow(&work, shown));
        let searched = self.why.poll_search(&work);
        self.report(errors.into_iter().map(Message::Failed));
        match searched {
            Some(Ok(worst)) => self.state.scene = worst.scene,
            Some(Err(error)) => self.report([Message::Failed(error)]),
            None => {}
        }
    }

    /// Computes the loss over the few scenes of the papers, where the loss is another one and is done.
    fn follow_few_scenes(&mut self, ctx: &egui::Context) {
        let Some(few) = self.settings.loss.question().few_scenes else {
            self.few = LossRun::default();
            return;
        };
        let asked = Asked { request: Request::Scenes(few), ..self.asked() };
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
            _ if self.photograph.edits_corners() => PhotographCommand::EditCorners(false).into(),
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
