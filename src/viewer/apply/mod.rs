//! Commands, carried out: the only place where the model changes.

mod display;
mod inspect;
mod materials;
mod photograph;
mod saving;
pub(super) mod scene;
mod training;
mod undo;
mod why;

use eframe::egui;

use super::app::App;
use super::browse;
use super::command::{Command, LossCommand, WindowCommand};
use super::panels::open::OpenWindow;
use super::panels::save::SaveWindow;
use super::save_kind::SaveKind;

impl App {
    /// Carries out one command.
    pub fn apply(&mut self, ctx: &egui::Context, command: Command) {
        match command {
            Command::Materials(command) => self.apply_to_materials(ctx, command),
            Command::Scene(command) => self.apply_to_scene(ctx, command),
            Command::Display(command) => self.apply_to_display(ctx, command),
            Command::Loss(command) => self.apply_to_loss(ctx, command),
            Command::Window(command) => self.apply_to_window(ctx, command),
            Command::Inspect(command) => self.apply_to_inspect(ctx, command),
            Command::Why(command) => self.apply_to_why(ctx, command),
            Command::Training(command) => self.apply_to_training(ctx, command),
            Command::Photograph(command) => self.apply_to_photograph(command),
        }
        ctx.request_repaint();
    }

    fn apply_to_loss(&mut self, ctx: &egui::Context, command: LossCommand) {
        let (prediction, convention) = (self.state.prediction, self.state.convention());
        match command {
            LossCommand::Compute => {
                let asked = self.asked();
                self.loss.start(ctx, &self.slots, &asked);
            }
            LossCommand::Cancel => self.loss.cancel(),
            LossCommand::SetAuto(on) => self.settings.auto_loss = on,
            LossCommand::SetSettings(settings) => self.settings.loss = settings,
            LossCommand::SortByLoss(on) => self.settings.sort_losses = on,
            LossCommand::Copy => {
                if let Some(text) = self.loss.losses().map(|losses| losses.report.text()) {
                    self.copy_text(ctx, text, "the losses as text");
                }
            }
            LossCommand::ShowStudy(true) => {
                self.study_window = true;
                self.study.keep_up(ctx, &self.slots, prediction, &convention);
            }
            LossCommand::ShowStudy(false) => {
                self.study_window = false;
                self.study.cancel();
            }
            LossCommand::StartStudy => self.study.start(ctx, &self.slots, prediction, &convention),
            LossCommand::CancelStudy => self.study.cancel(),
            LossCommand::UseSampling(sampling) => {
                self.settings.loss = self.settings.loss.with_sampling(sampling);
            }
            LossCommand::RemoveFileScenes => self.settings.loss = self.settings.loss.with_file(None),
        }
    }

    fn apply_to_window(&mut self, ctx: &egui::Context, command: WindowCommand) {
        match command {
            WindowCommand::ShowOpen(on) => self.open_window = on.then(|| OpenWindow::from(self.read)),
            WindowCommand::Browse { folder } => self.browsing = Some(browse::start(ctx, folder)),
            WindowCommand::ShowSave(on) => {
                self.save_window = on.then(|| SaveWindow::new(SaveKind::default(), self.picture_size));
            }
            WindowCommand::SaveScenes => {
                self.save_window = Some(SaveWindow::new(SaveKind::Scenes, self.picture_size));
            }
            WindowCommand::Save { what, path, size } => self.start_saving(ctx, what, path, size),
            WindowCommand::CopyPicture => self.copy_picture(ctx),
            WindowCommand::SetDark(on) => self.settings.dark = on,
            WindowCommand::SetScale(scale) => ctx.set_zoom_factor(scale),
            WindowCommand::ToggleSidePanel => *self.side_panel(ctx) ^= true,
            WindowCommand::ToggleHistograms => self.settings.histograms = !self.settings.histograms,
            WindowCommand::ChooseTab(tab) => self.settings.tab = tab,
            WindowCommand::ShowHelp(on) => self.help = on,
            WindowCommand::DismissMessage(number) => self.messages.dismiss(number),
            WindowCommand::DismissMessages => self.messages.dismiss_all(),
        }
    }
}
