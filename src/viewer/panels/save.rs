//! The dialog that saves the view, the renderings, a strip, the session or the scenes of the loss.

use std::path::PathBuf;

use eframe::egui::{self, RichText};

use crate::viewer::command::{Command, WindowCommand};
use crate::viewer::save_kind::SaveKind;
use crate::viewer::theme;

/// What is typed and chosen so far.
#[derive(Debug)]
pub(crate) struct SaveWindow {
    pub path: String,
    pub what: SaveKind,
    /// Size of a picture of the view, in pixels.
    size: [u32; 2],
    /// The path of an existing file, once the dialog has said that it exists.
    replaces: Option<String>,
    /// Whether the path field has been given the focus.
    focused: bool,
    /// Whether the file is being written.
    saving: bool,
    /// What went wrong.
    problem: Option<String>,
}

impl SaveWindow {
    /// `what` is chosen at first; `size` is the size of the view in the window, in pixels.
    pub(crate) fn new(what: SaveKind, size: [u32; 2]) -> Self {
        let path = what.proposal().to_owned();
        Self { path, what, size, replaces: None, focused: false, saving: false, problem: None }
    }

    /// `seen` is the size of the view in the window, in pixels.
    pub(crate) fn ui(&mut self, ctx: &egui::Context, seen: [u32; 2]) -> Vec<Command> {
        let mut commands = Vec::new();
        let mut open = true;
        egui::Window::new("Save")
            .open(&mut open)
            .collapsible(false)
            .default_width(420.0)
            .anchor(egui::Align2::CENTER_TOP, [0.0, 60.0])
            .show(ctx, |ui| {
                self.choice(ui);
                let label = ui.label("To file:");
                let field = egui::TextEdit::singleline(&mut self.path).desired_width(f32::INFINITY);
                let field = ui.add(field).labelled_by(label.id);
                if !std::mem::replace(&mut self.focused, true) {
                    field.request_focus();
                }
                let entered = field.lost_focus() && ui.input(|i| i.key_pressed(egui::Key::Enter));
                ui.label(RichText::new(self.what.explanation()).small().weak());
                if self.what == SaveKind::View {
                    self.sizes(ui, seen);
                }
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
                    _ => "Save file",
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

    /// What is saved; a name that was proposed follows.
    fn choice(&mut self, ui: &mut egui::Ui) {
        ui.horizontal(|ui| {
            for what in SaveKind::ALL {
                let button = ui.selectable_label(self.what == what, what.name());
                if button.on_hover_text(what.explanation()).clicked() {
                    if SaveKind::ALL.iter().any(|kind| kind.proposal() == self.path) {
                        self.path = what.proposal().to_owned();
                    }
                    self.what = what;
                }
            }
        });
    }

    fn sizes(&mut self, ui: &mut egui::Ui, seen: [u32; 2]) {
        ui.horizontal(|ui| {
            ui.label("Size");
            for (name, side, default) in [("Width in pixels", 0, seen[0]), ("Height in pixels", 1, seen[1])] {
                super::number(ui, name, &mut self.size[side], default, |drag| drag.range(64..=8192));
            }
            if ui.button("As in the window").clicked() {
                self.size = seen;
            }
        });
    }

    /// Shows what went wrong, and puts the cursor into the path field.
    pub(crate) fn fail(&mut self, problem: String) {
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
        commands.push(WindowCommand::Save { what: self.what, path, size: self.size }.into());
    }
}
