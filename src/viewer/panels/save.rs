//! The dialog that saves the view as a picture.

use std::path::PathBuf;

use eframe::egui::{self, RichText};

use crate::picture::export::Shows;
use crate::viewer::command::{Command, WindowCommand};
use crate::viewer::theme;

/// The path typed so far.
#[derive(Debug)]
pub struct SaveWindow {
    pub path: String,
    /// The path of an existing file, once the dialog has said that it exists.
    replaces: Option<String>,
    /// Whether the path field has been given the focus.
    focused: bool,
    /// Whether the file is being written.
    saving: bool,
    /// What went wrong.
    problem: Option<String>,
}

impl Default for SaveWindow {
    fn default() -> Self {
        Self {
            path: "svbrdf-view.png".to_owned(),
            replaces: None,
            focused: false,
            saving: false,
            problem: None,
        }
    }
}

impl SaveWindow {
    /// `shows` is the content of the file.
    pub fn ui(&mut self, ctx: &egui::Context, shows: Shows) -> Vec<Command> {
        let mut commands = Vec::new();
        let mut open = true;
        egui::Window::new("Save view")
            .open(&mut open)
            .collapsible(false)
            .default_width(420.0)
            .anchor(egui::Align2::CENTER_TOP, [0.0, 60.0])
            .show(ctx, |ui| {
                let label = ui.label("To file (.png as displayed, .exr as linear floats):");
                let field = egui::TextEdit::singleline(&mut self.path).desired_width(f32::INFINITY);
                let field = ui.add(field).labelled_by(label.id);
                if !std::mem::replace(&mut self.focused, true) {
                    field.request_focus();
                }
                let entered = field.lost_focus() && ui.input(|i| i.key_pressed(egui::Key::Enter));
                let what = match shows {
                    Shows::Radiance => "Renderings of ground truth and predictions",
                    Shows::LogDifference => "The log difference of every prediction",
                };
                let text = format!(
                    "{what}, side by side, one pixel per texel, with light, view, exposure and convention in the file's \
                     metadata; the same as `svbrdf render` writes."
                );
                ui.label(RichText::new(text).small().weak());
                let told = self.replaces.as_deref() == Some(self.path.trim());
                if told {
                    ui.colored_label(theme::problem(ui.visuals()), "This file exists.");
                }
                if let Some(problem) = &self.problem {
                    ui.colored_label(theme::problem(ui.visuals()), problem);
                }
                let text = match (self.saving, told) {
                    (true, _) => "Saving...",
                    (_, true) => "Replace it",
                    _ => "Save picture",
                };
                let clicked = ui.add_enabled(!self.saving, egui::Button::new(text)).clicked();
                if clicked || (entered && !self.saving) {
                    self.save(&mut commands);
                }
            });
        if !open {
            commands.push(WindowCommand::ShowSave(false).into());
        }
        commands
    }

    /// Shows what went wrong, and puts the cursor into the path field.
    pub fn fail(&mut self, problem: String) {
        self.problem = Some(problem);
        (self.saving, self.focused) = (false, false);
    }

    /// Saves, unless that replaces a file and the dialog has not said so yet.
    fn save(&mut self, commands: &mut Vec<Command>) {
        let path = PathBuf::from(self.path.trim());
        if path.exists() && self.replaces.as_deref() != Some(self.path.trim()) {
            self.replaces = Some(self.path.trim().to_owned());
            return;
        }
        (self.saving, self.problem) = (true, None);
        commands.push(WindowCommand::SaveView(path).into());
    }
}
