//! Where and by what a prediction is wrong: the losses of the current scene.

use eframe::egui::{self, Rect, RichText, Sense, Sides, vec2};

use crate::viewer::command::{Command, DisplayCommand};
use crate::viewer::names::shortened;
use crate::viewer::theme;

/// Characters of a name in a row.
const NAME: usize = 30;

/// What the tab shows.
#[derive(Debug)]
pub struct WhyPanel<'a> {
    /// The loss of each prediction in the current scene, and whether they are those of now.
    pub losses: Option<(&'a [f64], bool)>,
    /// Of the predictions.
    pub names: Vec<&'a str>,
    pub chosen: usize,
    /// Whether panes show the difference.
    pub difference: bool,
}

impl WhyPanel<'_> {
    pub fn ui(&self, ui: &mut egui::Ui) -> Vec<Command> {
        let mut commands = Vec::new();
        if self.names.is_empty() {
            ui.label("Open a prediction to compare with the ground truth.");
            return commands;
        }
        ui.strong("Loss in this scene").on_hover_text(
            "Under the light and view of the panes: the mean of the log difference over the texels",
        );
        match self.losses {
            Some((losses, current)) => {
                ui.scope(|ui| {
                    if !current {
                        ui.set_opacity(0.5);
                    }
                    self.rows(ui, losses, &mut commands);
                });
            }
            None => {
                ui.weak("Computing...");
            }
        }
        ui.add_space(6.0);
        let label = if self.difference { "Show the values" } else { "Show where: the difference" };
        if ui.button(label).on_hover_text("Value or difference in the panes (D)").clicked() {
            commands.push(DisplayCommand::ShowDifference(!self.difference).into());
        }
        commands
    }

    fn rows(&self, ui: &mut egui::Ui, losses: &[f64], commands: &mut Vec<Command>) {
        let most = losses.iter().copied().fold(f64::MIN_POSITIVE, f64::max);
        for (index, (loss, name)) in losses.iter().zip(shortened(&self.names, NAME)).enumerate() {
            let left = |ui: &mut egui::Ui| {
                ui.selectable_label(index == self.chosen, format!("{}  {name}", index + 1))
                    .on_hover_text(self.names[index])
            };
            let right = |ui: &mut egui::Ui| {
                ui.label(RichText::new(format!("{loss:.4}")).monospace());
            };
            let (response, ()) = Sides::new().shrink_left().truncate().show(ui, left, right);
            if response.clicked() {
                commands.push(DisplayCommand::ChoosePrediction(index).into());
            }
            let (area, _) = ui.allocate_exact_size(vec2(ui.available_width(), 6.0), Sense::hover());
            let bar = Rect::from_min_size(area.min, vec2(area.width() * (loss / most) as f32, area.height()));
            ui.painter().rect_filled(bar, 1.0, theme::series(index, ui.visuals().dark_mode));
        }
    }
}
