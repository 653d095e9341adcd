//! Dialog that saves the view, the renderings, a strip, a report, the session or the scenes of the loss.

use std::path::{Path, PathBuf};

use eframe::egui::{self, RichText};

use super::path_field::{PathField, dialog};
use crate::jobs::work::job::Job;
use crate::model::command::{BrowseFor, Command, WindowCommand};
use crate::model::settings::save_kind::{SaveKind, SaveRequest};
use crate::ui::widgets::theme;

/// What is typed and chosen so far.
#[derive(Debug)]
pub struct SaveDialog {
    pub path: String,
    pub what: SaveKind,
    /// Whether there is a list of materials to save.
    has_dataset: bool,
    /// The path of an existing file, once the dialog has said that it exists.
    replaces: Option<String>,
    /// Whether the button gets the focus, so that Return presses it.
    focus_button: bool,
    field: PathField,
}

impl SaveDialog {
    /// `what` is chosen at first.
    pub fn new(what: SaveKind, has_dataset: bool) -> Self {
        let path = what.proposal().to_owned();
        Self { path, what, has_dataset, replaces: None, focus_button: false, field: PathField::default() }
    }

    /// `saving` is the file that is being written.
    pub fn ui(&mut self, ctx: &egui::Context, saving: Option<&Job<PathBuf>>) -> Vec<Command> {
        let mut commands = Vec::new();
        let open = dialog(ctx, "Save", 420.0, |ui| self.contents(ui, saving, &mut commands));
        if !open {
            commands.push(WindowCommand::ShowSave(false).into());
        }
        commands
    }

    fn contents(&mut self, ui: &mut egui::Ui, saving: Option<&Job<PathBuf>>, commands: &mut Vec<Command>) {
        self.choice(ui);
        let field = self.field.ui(ui, "To file:", egui::TextEdit::singleline(&mut self.path));
        let entered = field.lost_focus() && ui.input(|i| i.key_pressed(egui::Key::Enter));
        ui.horizontal(|ui| {
            if ui
                .button("Browse...")
                .on_hover_text("Chooses the file with the dialog of the system")
                .clicked()
            {
                commands.push(WindowCommand::Browse(BrowseFor::Saving).into());
            }
            let folder = std::path::absolute(self.path.trim()).ok();
            let folder = folder.as_deref().and_then(Path::parent).map(|folder| folder.display().to_string());
            let folder = folder.map(|folder| format!("in {folder}")).unwrap_or_default();
            ui.add(egui::Label::new(RichText::new(&folder).small().weak()).truncate()).on_hover_text(folder);
        });
        ui.label(RichText::new(self.what.explanation()).small().weak());
        let replaces = self.replaces.as_deref() == Some(self.path.trim());
        if let Some(job) = saving {
            progress(ui, job, commands);
        } else {
            ui.horizontal(|ui| {
                let button = ui.button(if replaces { "Replace it" } else { "Save file" });
                if std::mem::take(&mut self.focus_button) {
                    button.request_focus();
                }
                if button.on_hover_text("Return in the field").clicked() || entered {
                    self.save(commands);
                }
                if replaces {
                    ui.colored_label(theme::problem(ui.visuals()), "This file exists.");
                }
            });
        }
        self.field.problem(ui);
    }

    /// Puts a path into the field. That a file exists, the dialog of the system has asked.
    pub fn fill(&mut self, path: &Path) {
        self.path = path.display().to_string();
        self.replaces = Some(self.path.clone()).filter(|_| path.exists());
        self.field.clear();
    }

    /// What is saved; a name that was proposed follows.
    fn choice(&mut self, ui: &mut egui::Ui) {
        ui.horizontal(|ui| {
            let of_dataset = SaveKind::OF_DATASET.into_iter().filter(|_| self.has_dataset);
            for what in SaveKind::ALL.into_iter().chain(of_dataset) {
                let button = ui.selectable_label(self.what == what, what.name());
                if button.on_hover_text(what.explanation()).clicked() {
                    if SaveKind::ALL
                        .iter()
                        .chain(&SaveKind::OF_DATASET)
                        .any(|kind| kind.proposal() == self.path)
                    {
                        self.path = what.proposal().to_owned();
                    }
                    self.what = what;
                    // Return saves.
                    self.field = PathField::default();
                }
            }
        });
    }

    /// Shows what went wrong, and puts the cursor into the path field.
    pub fn fail(&mut self, problem: String) {
        self.field.fail(problem);
    }

    /// Saves, unless that replaces a file and the dialog has not said so yet.
    fn save(&mut self, commands: &mut Vec<Command>) {
        let path = PathBuf::from(self.path.trim());
        if path.exists() && self.replaces.as_deref() != Some(self.path.trim()) {
            self.replaces = Some(self.path.trim().to_owned());
            self.focus_button = true;
            return;
        }
        self.field.clear();
        commands.push(WindowCommand::Save(SaveRequest { kind: self.what, path }).into());
    }
}

/// The progress of what is being written, in one line, and its end.
fn progress(ui: &mut egui::Ui, job: &Job<PathBuf>, commands: &mut Vec<Command>) {
    ui.horizontal(|ui| {
        let cancel = ui.button("Cancel saving").on_hover_text("Stop; no file is written");
        if cancel.clicked() {
            commands.push(WindowCommand::CancelSaving.into());
        }
        let text = format!("saving, {} s", job.elapsed().as_secs());
        let height = ui.spacing().interact_size.y;
        let bar = egui::ProgressBar::new(job.fraction()).text(text).desired_height(height).corner_radius(3.0);
        ui.add(bar).on_hover_text("It goes on when this dialog is closed");
    });
}
