//! The whole window, drawn: each part is given what it shows and returns commands.

use eframe::egui;

use super::app::App;
use super::command::{Command, WindowCommand};
use super::panels;
use super::panels::legend::LegendStrip;
use super::panels::loss::LossPanel;
use super::panels::materials::MaterialsPanel;
use super::panels::scene::ScenePanel;
use super::panels::status::StatusBar;
use super::panels::study::{self, StudyWindow};
use super::panels::top::TopBar;
use super::panes::Scenery;

/// Least width of the side panel, in points: its contents do not fit into less.
const SIDE: f32 = 320.0;

impl App {
    /// Draws everything and returns the commands of the person.
    pub(super) fn draw(&mut self, ui: &mut egui::Ui) -> Vec<Command> {
        let mut commands = Vec::new();
        egui::Panel::top("top").show(ui, |ui| commands.extend(self.top(ui)));
        egui::Panel::bottom("status").show(ui, |ui| self.status(ui));
        let mut side_panel = self.settings.side_panel;
        egui::Panel::right("side")
            .default_size(SIDE)
            .size_range(SIDE..=(0.4 * ui.available_width()).max(SIDE))
            .show_collapsible(ui, &mut side_panel, |ui| commands.extend(self.side(ui)));
        if side_panel != self.settings.side_panel {
            commands.push(WindowCommand::ToggleSidePanel.into());
        }
        let area = ui.available_rect_before_wrap();
        self.picture_size = [area.width(), area.height()].map(|side| (side * ui.pixels_per_point()) as u32);
        commands.extend(self.content(ui));
        commands.extend(panels::messages::ui(ui.ctx(), area, &self.messages));
        commands.extend(self.windows(ui.ctx()));
        commands
    }

    /// The panes and the legend: what a picture of the view has.
    pub(super) fn content(&mut self, ui: &mut egui::Ui) -> Vec<Command> {
        let mut commands = Vec::new();
        if self.state.difference && !self.slots.predictions().is_empty() {
            egui::Panel::bottom("legend").show(ui, |ui| commands.extend(self.legend(ui)));
        }
        egui::CentralPanel::no_frame().show(ui, |ui| commands.extend(self.panes(ui)));
        commands
    }

    fn top(&self, ui: &mut egui::Ui) -> Vec<Command> {
        let bar = TopBar {
            state: &self.state,
            dark: self.settings.dark,
            side_panel: self.settings.side_panel,
            swapped: self.swapped,
        };
        bar.ui(ui)
    }

    fn status(&self, ui: &mut egui::Ui) {
        let bar = StatusBar {
            state: &self.state,
            slots: &self.slots.slots,
            hovered: self.viewport.hovered,
            adapter: self.gpu.as_ref().map(|g| &g.gpu.report),
            frame_ms: self.frame_ms,
        };
        bar.ui(ui);
    }

    fn side(&self, ui: &mut egui::Ui) -> Vec<Command> {
        let mut commands = Vec::new();
        let section = |ui: &mut egui::Ui, name: &str, add: &mut dyn FnMut(&mut egui::Ui)| {
            egui::CollapsingHeader::new(name).default_open(true).show_unindented(ui, |ui| add(ui));
        };
        let scene = ScenePanel { state: &self.state, highlight_follows: self.settings.highlight_follows };
        let loss = LossPanel {
            settings: &self.settings.loss,
            auto: self.settings.auto_loss,
            run: &self.loss,
            slots: &self.slots,
            chosen: self.state.prediction,
        };
        let materials = MaterialsPanel { slots: &self.slots, watch: self.settings.watch };
        egui::ScrollArea::vertical().auto_shrink([false, false]).show(ui, |ui| {
            section(ui, "Scene", &mut |ui| commands.extend(scene.ui(ui)));
            section(ui, "Rendering loss", &mut |ui| {
                commands.extend(loss.ui(ui));
                commands.extend(study::button(ui, !self.slots.predictions().is_empty()));
            });
            section(ui, "Materials", &mut |ui| commands.extend(materials.ui(ui)));
        });
        commands
    }

    fn legend(&self, ui: &mut egui::Ui) -> Vec<Command> {
        let strip = LegendStrip {
            quantity: self.state.quantity,
            kind: self.state.difference_kind(),
            set_range: self.state.differences.range(self.state.quantity),
            range: self.difference.range(&self.slots, &self.state),
            distributions: self.difference.distributions(&self.slots, &self.state),
            current: self.difference.is_current(&self.slots, &self.state),
            names: self.slots.predictions().iter().map(|slot| slot.name()).collect(),
            chosen: self.state.prediction,
        };
        strip.ui(ui)
    }

    fn panes(&mut self, ui: &mut egui::Ui) -> Vec<Command> {
        let peek = ui.input(|i| i.key_down(egui::Key::G)) && !ui.ctx().text_edit_focused();
        let scenery = Scenery {
            slots: &self.slots.slots,
            state: &self.state,
            dark: self.settings.dark,
            highlight_follows: self.settings.highlight_follows,
            peek,
            swapped: self.swapped,
            reading: !self.slots.openings.is_empty(),
            range: self.difference.range(&self.slots, &self.state),
        };
        self.viewport.ui(ui, &scenery, self.gpu.as_mut())
    }

    fn windows(&mut self, ctx: &egui::Context) -> Vec<Command> {
        let mut commands = Vec::new();
        if self.help {
            commands.extend(panels::help::ui(ctx));
        }
        if self.study_window {
            commands.extend(self.study_window(ctx));
        }
        if let Some(window) = &mut self.open_window {
            commands.extend(window.ui(ctx, &self.settings.recent, self.settings.last.as_ref()));
        }
        if let Some(window) = &mut self.save_window {
            commands.extend(window.ui(ctx, self.picture_size));
        }
        commands
    }

    fn study_window(&self, ctx: &egui::Context) -> Vec<Command> {
        let window = StudyWindow {
            run: &self.study,
            measured: self.study.measured(&self.slots, self.state.prediction, &self.state.convention()),
            current: self.settings.loss.sampling(),
        };
        window.ui(ctx)
    }
}
