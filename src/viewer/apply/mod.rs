//! Commands, carried out: the only place where the model changes.

mod display;
mod inspect;
mod scene;

use eframe::egui;

use super::app::App;
use super::command::{Command, LossCommand, MaterialsCommand, WindowCommand};
use super::message::Message;
use super::panels::open::OpenWindow;
use super::save;
use super::slots::Target;
use super::worker::Task;
use crate::files::read::EXTENSIONS;

impl App {
    /// Carries out one command.
    pub fn apply(&mut self, ctx: &egui::Context, command: Command) {
        match command {
            Command::Materials(command) => self.apply_to_materials(ctx, command),
            Command::Scene(command) => self.apply_to_scene(ctx, command),
            Command::Display(command) => self.apply_to_display(command),
            Command::Loss(command) => self.apply_to_loss(ctx, command),
            Command::Window(command) => self.apply_to_window(ctx, command),
            Command::Inspect(command) => self.apply_to_inspect(ctx, command),
        }
        ctx.request_repaint();
    }

    fn apply_to_materials(&mut self, ctx: &egui::Context, command: MaterialsCommand) {
        let gpu = self.gpu.as_ref().map(|g| &g.gpu);
        match command {
            MaterialsCommand::Open { paths, replace, read } => {
                self.read = read;
                let target = if replace { Target::Everything } else { Target::Predictions };
                self.slots.open(ctx, gpu, paths.into_iter().map(|p| (p, read)).collect(), target);
            }
            MaterialsCommand::OpenBuiltIn => self.slots.open_built_in(ctx, gpu),
            MaterialsCommand::Reload => self.slots.reload(ctx, gpu, None),
            MaterialsCommand::ReadAs { slot, read } => self.slots.read_as(ctx, gpu, slot, read),
            MaterialsCommand::SaveAssumptions { slot } => {
                let saved = self.slots.save_assumptions(ctx, gpu, slot);
                self.report(saved.err().map(Message::Failed));
            }
            MaterialsCommand::Close(slot) => self.close_prediction(slot),
            MaterialsCommand::MakeGroundTruth(slot) => self.slots.make_ground_truth(slot),
            MaterialsCommand::SetWatch(on) => self.settings.watch = on,
            MaterialsCommand::SetFit(on) => self.slots.rules.fit = on,
        }
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
                if let Some(losses) = self.loss.losses() {
                    ctx.copy_text(losses.report.text());
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
        }
    }

    fn apply_to_window(&mut self, ctx: &egui::Context, command: WindowCommand) {
        match command {
            WindowCommand::ShowOpen(on) => self.open_window = on.then(|| OpenWindow::from(self.read)),
            WindowCommand::Browse { folder } => self.browsing = Some(browse(ctx, folder)),
            WindowCommand::ShowSave(on) => self.save_window = on.then(Default::default),
            WindowCommand::SaveView(path) => {
                self.saving = Some(save::start(ctx, &self.slots, &self.state, path));
            }
            WindowCommand::SetDark(on) => self.settings.dark = on,
            WindowCommand::SetScale(scale) => ctx.set_zoom_factor(scale),
            WindowCommand::ToggleSidePanel => *self.side_panel(ctx) ^= true,
            WindowCommand::ToggleHistograms => self.settings.histograms = !self.settings.histograms,
            WindowCommand::ChooseTab(tab) => self.settings.tab = tab,
            WindowCommand::ShowHelp(on) => self.help = on,
            WindowCommand::DismissMessages => self.dismiss_messages(),
        }
    }

    /// Closes the material in slot `slot`; the chosen prediction stays the same one where it can.
    fn close_prediction(&mut self, slot: usize) {
        self.slots.close(slot);
        let state = &mut self.state;
        if slot <= state.prediction {
            state.prediction = state.prediction.saturating_sub(1);
        }
        state.prediction = state.prediction.min(self.slots.predictions().len().saturating_sub(1));
    }
}

/// Asks for files or folders with the system's dialog, without blocking the window.
fn browse(ctx: &egui::Context, folder: bool) -> Task<Vec<std::path::PathBuf>> {
    let dialog = rfd::AsyncFileDialog::new().set_title("Open materials");
    Task::start(ctx, move |_| {
        let chosen = if folder {
            pollster::block_on(dialog.pick_folders())
        } else {
            pollster::block_on(dialog.add_filter("materials", &EXTENSIONS).pick_files())
        };
        Ok(chosen.unwrap_or_default().iter().map(|handle| handle.path().to_owned()).collect())
    })
}
