//! Dialog that opens materials: by path, by the system's file dialog, or from the recent ones.

use std::path::PathBuf;

use eframe::egui::{self, RichText};

use svbrdf_files::read::ReadOptions;
use svbrdf_files::session::Session;

use super::path_field::{PathField, dialog};
use crate::viewer::model::command::{Command, MaterialsCommand, WindowCommand};
use crate::viewer::model::material::source::file_name;
use crate::viewer::ui::widgets::read_options::read_options;

/// The paths and choices so far.
#[derive(Debug, Default)]
pub struct OpenDialog {
    /// One path a line.
    pub text: String,
    pub as_predictions: bool,
    pub read: ReadOptions,
    /// Whether its materials have been asked for.
    pub submitted: bool,
    /// The number of the opening that reads its materials.
    pub opening: Option<u64>,
    field: PathField,
}

/// Height below the list of recent materials, and least height of the list.
const BELOW_RECENT: f32 = 230.0;
const LEAST_RECENT: f32 = 60.0;

/// The end of a path that fits into a line: paths of one run differ in their ends.
fn ending(ui: &egui::Ui, path: &str) -> String {
    let font = egui::TextStyle::Button.resolve(ui.style());
    let room = ui.available_width() - 2.0 * ui.spacing().button_padding.x - 8.0;
    let width = |text: &str| {
        ui.ctx().fonts_mut(|f| f.layout_no_wrap(text.to_owned(), font.clone(), egui::Color32::WHITE).size().x)
    };
    if width(path) <= room {
        return path.to_owned();
    }
    let starts = path.char_indices().map(|(at, _)| format!("...{}", &path[at..]));
    starts.skip(1).find(|end| width(end) <= room).unwrap_or_else(|| path.to_owned())
}

/// The button that opens the last materials again.
fn reopen(ui: &mut egui::Ui, last: &Session, commands: &mut Vec<Command>) {
    let names: Vec<String> = last.materials.iter().filter_map(|m| m.path.as_deref()).map(file_name).collect();
    let hover = format!("{}, as they were shown (Ctrl+Shift+O)", names.join(", "));
    if ui.button("Reopen last").on_hover_text(hover).clicked() {
        commands.push(MaterialsCommand::ReopenLast.into());
    }
}

impl From<ReadOptions> for OpenDialog {
    fn from(read: ReadOptions) -> Self {
        Self { read, ..Self::default() }
    }
}

impl OpenDialog {
    pub fn ui(&mut self, ctx: &egui::Context, recent: &[PathBuf], last: Option<&Session>) -> Vec<Command> {
        let mut commands = Vec::new();
        let open = dialog(ctx, "Open materials", 460.0, |ui| {
            self.paths(ui, &mut commands);
            if let Some(last) = last {
                reopen(ui, last, &mut commands);
            }
            // The buttons stay visible, however long the list is.
            let room = ui.ctx().content_rect().bottom() - ui.cursor().top() - BELOW_RECENT;
            egui::ScrollArea::vertical()
                .max_height(room.max(LEAST_RECENT))
                .show(ui, |ui| self.recent(ui, recent));
            ui.separator();
            self.choices(ui, &mut commands);
        });
        if !open {
            commands.push(WindowCommand::ShowOpen(false).into());
        }
        commands
    }

    /// Shows what went wrong, and puts the cursor into the path field.
    pub fn fail(&mut self, problem: String) {
        self.field.fail(problem);
        (self.submitted, self.opening) = (false, None);
    }

    fn paths(&mut self, ui: &mut egui::Ui, commands: &mut Vec<Command>) {
        let field =
            egui::TextEdit::multiline(&mut self.text).desired_rows(3).hint_text("materials/brick.png");
        self.field.ui(ui, "Files, folders or name prefixes, one a line:", field);
        self.field.problem(ui);
        ui.horizontal(|ui| {
            if ui.button("Browse files...").clicked() {
                commands.push(WindowCommand::Browse { folder: false }.into());
            }
            if ui.button("Browse folders...").clicked() {
                commands.push(WindowCommand::Browse { folder: true }.into());
            }
        });
    }

    fn recent(&mut self, ui: &mut egui::Ui, recent: &[PathBuf]) {
        if recent.is_empty() {
            return;
        }
        ui.label(RichText::new("Recent").weak());
        for path in recent {
            let path = path.display().to_string();
            let end = ending(ui, &path);
            if ui.selectable_label(false, end).on_hover_text(&path).clicked() {
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
            "The first is the ground truth, the others are predictions",
        );
        ui.radio_value(&mut self.as_predictions, true, "All are predictions");
        ui.collapsing("How to read them...", |ui| {
            read_options(ui, "the materials to open", &mut self.read, &[]);
        });
        let paths: Vec<PathBuf> =
            self.text.lines().map(str::trim).filter(|l| !l.is_empty()).map(PathBuf::from).collect();
        let ready = !paths.is_empty() && !self.submitted;
        let text = if self.submitted { "Reading..." } else { "Open these" };
        let button = ui.add_enabled(ready, egui::Button::new(text));
        let entered = ui.input_mut(|i| i.consume_key(egui::Modifiers::COMMAND, egui::Key::Enter));
        if button.on_hover_text("Ctrl+Enter").clicked() || (entered && ready) {
            self.submitted = true;
            self.field.clear();
            commands.push(
                MaterialsCommand::Open { paths, replace: !self.as_predictions, read: self.read }.into(),
            );
        }
    }
}
