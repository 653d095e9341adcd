//! The window that saves the view as a picture.

use std::path::PathBuf;

use eframe::egui::{self, RichText};

use crate::viewer::command::Command;

/// The path typed so far.
#[derive(Debug)]
pub struct SaveWindow {
    pub path: String,
}

impl Default for SaveWindow {
    fn default() -> Self {
        Self { path: "svbrdf-view.png".to_owned() }
    }
}

impl SaveWindow {
    pub fn ui(&mut self, ctx: &egui::Context) -> Vec<Command> {
        let mut commands = Vec::new();
        let mut open = true;
        egui::Window::new("Save view")
            .open(&mut open)
            .collapsible(false)
            .default_width(420.0)
            .anchor(egui::Align2::CENTER_TOP, [0.0, 60.0])
            .show(ctx, |ui| {
                let label = ui.label("To file (.png as displayed, .exr as linear floats):");
                ui.add(egui::TextEdit::singleline(&mut self.path).desired_width(f32::INFINITY))
                    .labelled_by(label.id);
                ui.label(
                    RichText::new(
                        "Ground truth and predictions side by side, a pixel a texel, with light, view, exposure \
                         and convention in the file: what `svbrdf render` writes for the same numbers.",
                    )
                    .small()
                    .weak(),
                );
                if ui.button("Save picture").clicked() {
                    commands.push(Command::SaveView(PathBuf::from(self.path.trim())));
                    commands.push(Command::ShowSave(false));
                }
            });
        if !open {
            commands.push(Command::ShowSave(false));
        }
        commands
    }
}
