//! The menu of the bar: what is seldom used.

use eframe::egui;

use super::top::TopBar;
use crate::model::command::{Command, DatasetCommand, WindowCommand};
use crate::model::dataset::DatasetState;
use crate::model::dataset::list::ListView;

/// The scales of text and controls that the menu offers, in percent.
const SCALES: [u16; 8] = [75, 100, 125, 150, 175, 200, 250, 300];

impl TopBar<'_> {
    pub fn menu(&self, ui: &mut egui::Ui, commands: &mut Vec<Command>) {
        if let Some(open) = &self.dataset.open {
            self.of_dataset(ui, open.noun(), commands);
            ui.separator();
        }
        let theme = if self.dark { "Light theme" } else { "Dark theme" };
        if ui.button(theme).on_hover_text("Colours of the window").clicked() {
            commands.push(WindowCommand::SetDark(!self.dark).into());
            ui.close();
        }
        let scales = ui.menu_button("UI scale", |ui| {
            for percent in SCALES {
                let scale = f32::from(percent) / 100.0;
                let is_current = (self.scale - scale).abs() < 1e-3;
                if ui.selectable_label(is_current, format!("{percent}%")).clicked() {
                    commands.push(WindowCommand::SetScale(scale).into());
                    ui.close();
                }
            }
        });
        let hover = "Size of text and controls (Ctrl with plus, minus; Ctrl+0 for 100%)";
        scales.response.on_hover_text(hover);
    }

    /// The parts of the window that only a data set has; `noun` is what it lists.
    fn of_dataset(&self, ui: &mut egui::Ui, noun: &str, commands: &mut Vec<Command>) {
        let DatasetState { list, sheet, .. } = self.dataset;
        let label = ui.selectable_label(list.is_open, format!("List of {noun}s"));
        if label.on_hover_text("Beside the panes (A)").clicked() {
            commands
                .push(DatasetCommand::SetList(ListView { is_open: !list.is_open, ..list.clone() }).into());
        }
        let label = ui.selectable_label(sheet.is_open, "Contact sheet");
        if label.on_hover_text(format!("All {noun}s under the present light (S)")).clicked() {
            commands.push(DatasetCommand::ShowSheet(!sheet.is_open).into());
            ui.close();
        }
    }
}
