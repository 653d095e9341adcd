//! The window that opens materials: by path, by the system's dialog, or again.

use std::path::PathBuf;

use eframe::egui::{self, RichText};

use crate::material::read::ReadOptions;
use crate::viewer::command::Command;

/// What has been typed and chosen so far.
#[derive(Debug, Default)]
pub struct OpenWindow {
    /// One path a line.
    pub text: String,
    pub as_predictions: bool,
    pub read: ReadOptions,
    /// Whether the path field has had the focus that it gets when the window opens.
    focused: bool,
}

impl From<ReadOptions> for OpenWindow {
    fn from(read: ReadOptions) -> Self {
        Self { read, ..Self::default() }
    }
}

impl OpenWindow {
    pub fn ui(&mut self, ctx: &egui::Context, recent: &[PathBuf]) -> Vec<Command> {
        let mut commands = Vec::new();
        let mut open = true;
        egui::Window::new("Open materials")
            .open(&mut open)
            .collapsible(false)
            .default_width(460.0)
            .anchor(egui::Align2::CENTER_TOP, [0.0, 60.0])
            .show(ctx, |ui| {
                self.paths(ui, &mut commands);
                self.recent(ui, recent);
                ui.separator();
                self.choices(ui, &mut commands);
            });
        if !open {
            commands.push(Command::ShowOpen(false));
        }
        commands
    }

    fn paths(&mut self, ui: &mut egui::Ui, commands: &mut Vec<Command>) {
        let label = ui.label("Files, folders or name prefixes, one a line:");
        let field = egui::TextEdit::multiline(&mut self.text)
            .desired_rows(3)
            .desired_width(f32::INFINITY)
            .hint_text("materials/brick.png");
        let field = ui.add(field).labelled_by(label.id);
        if !std::mem::replace(&mut self.focused, true) {
            field.request_focus();
        }
        ui.horizontal(|ui| {
            if ui.button("Browse files...").clicked() {
                commands.push(Command::Browse { folder: false });
            }
            if ui.button("Browse folders...").clicked() {
                commands.push(Command::Browse { folder: true });
            }
        });
    }

    fn recent(&mut self, ui: &mut egui::Ui, recent: &[PathBuf]) {
        if recent.is_empty() {
            return;
        }
        ui.label(RichText::new("Opened before").weak());
        for path in recent {
            let path = path.display().to_string();
            if ui.add(egui::Button::selectable(false, &path).truncate()).clicked() {
                self.add(&path);
            }
        }
    }

    /// Adds a path as a line of its own.
    pub fn add(&mut self, path: &str) {
        if !self.text.is_empty() && !self.text.ends_with('\n') {
            self.text.push('\n');
        }
        self.text += path;
    }

    fn choices(&mut self, ui: &mut egui::Ui, commands: &mut Vec<Command>) {
        ui.radio_value(
            &mut self.as_predictions,
            false,
            "The first is the ground truth, the others predictions",
        );
        ui.radio_value(&mut self.as_predictions, true, "All are further predictions");
        super::read_options(ui, "what is opened", &mut self.read, &[]);
        let paths: Vec<PathBuf> =
            self.text.lines().map(str::trim).filter(|l| !l.is_empty()).map(PathBuf::from).collect();
        let button = ui.add_enabled(!paths.is_empty(), egui::Button::new("Open these"));
        if button.clicked() {
            commands.push(Command::Open { paths, replace: !self.as_predictions, read: self.read });
            commands.push(Command::ShowOpen(false));
        }
    }
}
