//! Dialog that opens materials: by path, by the system's file dialog, or from the recent ones.

use std::path::PathBuf;

use eframe::egui::{self, RichText};

use svbrdf_files::read::ReadOptions;
use svbrdf_files::session::Session;

use super::path_field::{PathField, dialog};
use crate::model::command::{
    BrowseFor, Command, DatasetCommand, MaterialsCommand, PhotographCommand, WindowCommand,
};
use crate::model::material::source::file_name;

/// The paths and choices so far.
#[derive(Debug, Default)]
pub struct OpenDialog {
    /// One path a line.
    pub text: String,
    pub opens: Opens,
    /// Whether its materials have been asked for.
    pub submitted: bool,
    /// The number of the opening that reads its materials.
    pub opening: Option<u64>,
    field: PathField,
}

/// What the paths are.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Opens {
    #[default]
    Comparison,
    Predictions,
    Dataset,
    Photograph,
}

/// Height below the list of recent materials, and least height of the list.
const BELOW_RECENT: f32 = 230.0;
const LEAST_RECENT: f32 = 60.0;

/// The materials of a comparison, the ground truth first.
fn compared(session: &Session) -> String {
    if let Some(dataset) = &session.dataset {
        if !dataset.predictions.is_empty() {
            let count = dataset.predictions.len();
            return format!("{} | {count} predictions", file_name(&dataset.ground_truths));
        }
        let methods: Vec<&str> = dataset.methods.iter().map(|method| method.name.as_str()).collect();
        return format!("data set {} | {}", file_name(&dataset.ground_truths), methods.join(", "));
    }
    let names = session.materials.iter().map(|one| match (&one.path, one.built_in) {
        (Some(path), _) => file_name(path),
        (None, _) => "built-in material".to_owned(),
    });
    let names: Vec<String> = names.collect();
    match names.split_first() {
        Some((first, [])) => first.clone(),
        Some((first, others)) => format!("{first} | {}", others.join(", ")),
        None => String::new(),
    }
}

/// The paths of a comparison, one a line.
fn paths(session: &Session) -> String {
    if let Some(dataset) = &session.dataset {
        return dataset.paths().map(|path| path.display().to_string()).collect::<Vec<_>>().join("\n");
    }
    let paths = session.materials.iter().filter_map(|one| one.path.as_deref());
    paths.map(|path| path.display().to_string()).collect::<Vec<_>>().join("\n")
}

impl OpenDialog {
    pub fn ui(&mut self, ctx: &egui::Context, recent: &[Session]) -> Vec<Command> {
        let mut commands = Vec::new();
        let open = dialog(ctx, "Open materials", 460.0, |ui| {
            let entered = self.paths(ui, &mut commands);
            // The buttons stay visible, however long the list is.
            let room = ui.ctx().content_rect().bottom() - ui.cursor().top() - BELOW_RECENT;
            egui::ScrollArea::vertical()
                .max_height(room.max(LEAST_RECENT))
                .show(ui, |ui| recent_comparisons(ui, recent, &mut commands));
            ui.separator();
            self.choices(ui, entered, &mut commands);
            self.field.problem(ui);
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

    /// The field of the paths; whether Return was pressed in it.
    fn paths(&mut self, ui: &mut egui::Ui, commands: &mut Vec<Command>) -> bool {
        let new_line = egui::KeyboardShortcut::new(egui::Modifiers::SHIFT, egui::Key::Enter);
        let field = egui::TextEdit::multiline(&mut self.text)
            .desired_rows(3)
            .hint_text("materials/brick.png")
            .return_key(new_line);
        let field = self.field.ui(ui, "Files, folders or name prefixes, one a line:", field);
        let entered =
            field.has_focus() && ui.input_mut(|i| i.consume_key(egui::Modifiers::NONE, egui::Key::Enter));
        field.on_hover_text("Return opens them; Shift + Return begins a new line");
        ui.horizontal(|ui| {
            if ui
                .button("Browse files...")
                .on_hover_text("Adds files with the file dialog of the system")
                .clicked()
            {
                commands.push(WindowCommand::Browse(BrowseFor::Files).into());
            }
            if ui
                .button("Browse folders...")
                .on_hover_text("Adds folders, each with the maps of one material")
                .clicked()
            {
                commands.push(WindowCommand::Browse(BrowseFor::Folders).into());
            }
        });
        entered
    }

    /// Adds a path as a line of its own.
    pub fn add(&mut self, path: &str) {
        if !self.text.is_empty() && !self.text.ends_with('\n') {
            self.text.push('\n');
        }
        self.text += path;
    }

    fn choices(&mut self, ui: &mut egui::Ui, entered: bool, commands: &mut Vec<Command>) {
        for (opens, text, hover) in [
            (
                Opens::Comparison,
                "The first is the ground truth, the others are predictions",
                "They replace the materials in the window",
            ),
            (Opens::Predictions, "All are predictions", "They are added to the materials in the window"),
            (
                Opens::Dataset,
                "A data set: a folder of ground truths, then one of each method",
                "Materials are matched by name, as `svbrdf rank --dataset` does; or one CSV table of pairs",
            ),
            (
                Opens::Photograph,
                "A photograph in the place of the ground truth",
                "Rectified, under the light and view of the window; or a folder of photographs with capture.json",
            ),
        ] {
            ui.radio_value(&mut self.opens, opens, text).on_hover_text(hover);
        }
        let paths: Vec<PathBuf> =
            self.text.lines().map(str::trim).filter(|l| !l.is_empty()).map(PathBuf::from).collect();
        let ready = !paths.is_empty() && !self.submitted;
        let text = if self.submitted { "Reading..." } else { "Open these" };
        let button =
            ui.add_enabled(ready, egui::Button::new(text)).on_disabled_hover_text("Needs a path above");
        let entered = entered || ui.input_mut(|i| i.consume_key(egui::Modifiers::COMMAND, egui::Key::Enter));
        if button.on_hover_text("Return in the field, or Ctrl+Return").clicked() || (entered && ready) {
            self.submitted = true;
            self.field.clear();
            commands.push(match self.opens {
                Opens::Dataset => DatasetCommand::Open(paths).into(),
                Opens::Photograph => PhotographCommand::Open(paths[0].clone()).into(),
                opens => {
                    let replace = opens == Opens::Comparison;
                    MaterialsCommand::Open { paths, replace, read: ReadOptions::AUTO }.into()
                }
            });
        }
    }
}

/// The last comparisons; a click opens one as it was shown.
fn recent_comparisons(ui: &mut egui::Ui, recent: &[Session], commands: &mut Vec<Command>) {
    if recent.is_empty() {
        return;
    }
    ui.label(RichText::new("Recent comparisons").weak());
    for (index, session) in recent.iter().enumerate() {
        let button = egui::Button::selectable(false, compared(session)).truncate();
        let key = if index == 0 { " (Ctrl+Shift+O)" } else { "" };
        let hover = format!("Opens these as they were shown{key}:\n{}", paths(session));
        if ui.add(button).on_hover_text(hover).clicked() {
            commands.push(MaterialsCommand::Reopen(index).into());
        }
    }
}
