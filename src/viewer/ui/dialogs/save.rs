//! Dialog that saves the view, the renderings, a strip, a report, the session or the scenes of the loss.

use std::path::{Path, PathBuf};

use eframe::egui::{self, RichText};

use super::path_field::{PathField, dialog};
use crate::jobs::work::job::Job;
use crate::model::command::{BrowseFor, Command, WindowCommand};
use crate::model::settings::save_kind::{SaveKind, SaveRequest};
use crate::ui::widgets::number;
use crate::ui::widgets::theme;

/// Width and height of a picture of the view, in pixels.
const SIDE: std::ops::RangeInclusive<u32> = 64..=8192;

/// What is typed and chosen so far.
#[derive(Debug)]
pub struct SaveDialog {
    pub path: String,
    pub what: SaveKind,
    /// Whether there is a list of materials to save.
    has_dataset: bool,
    /// Size of a picture of the view, in pixels.
    size: [u32; 2],
    /// Whether a picture of the view has the handles of light and view.
    handles: bool,
    /// The path of an existing file, once the dialog has said that it exists.
    replaces: Option<String>,
    /// Whether the button gets the focus, so that Return presses it.
    focus_button: bool,
    field: PathField,
}

impl SaveDialog {
    /// `what` is chosen at first; `size` is the size of the view in the window, in pixels.
    pub fn new(what: SaveKind, size: [u32; 2], has_dataset: bool) -> Self {
        let path = what.proposal().to_owned();
        Self {
            path,
            what,
            has_dataset,
            size,
            handles: true,
            replaces: None,
            focus_button: false,
            field: PathField::default(),
        }
    }

    /// `saving` is the file that is being written; `view_size` the size of the view in the window, in pixels.
    pub fn ui(
        &mut self,
        ctx: &egui::Context,
        saving: Option<&Job<PathBuf>>,
        view_size: [u32; 2],
    ) -> Vec<Command> {
        let mut commands = Vec::new();
        let open = dialog(ctx, "Save", 420.0, |ui| self.contents(ui, saving, view_size, &mut commands));
        if !open {
            commands.push(WindowCommand::ShowSave(false).into());
        }
        commands
    }

    fn contents(
        &mut self,
        ui: &mut egui::Ui,
        saving: Option<&Job<PathBuf>>,
        view_size: [u32; 2],
        commands: &mut Vec<Command>,
    ) {
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
        if self.what == SaveKind::View {
            self.sizes(ui, view_size);
            ui.checkbox(&mut self.handles, "With handles")
                .on_hover_text("The sun and the eye, which mark light and view");
        }
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

    fn sizes(&mut self, ui: &mut egui::Ui, view_size: [u32; 2]) {
        ui.horizontal(|ui| {
            ui.label("Size");
            for (name, side, default) in
                [("Width in pixels", 0, view_size[0]), ("Height in pixels", 1, view_size[1])]
            {
                number(ui, name, &mut self.size[side], default, |drag| drag.range(SIDE))
                    .on_hover_text(format!("{name} of the picture"));
            }
            if ui.button("As in the window").on_hover_text("The size of the panes in the window").clicked() {
                self.size = view_size;
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
        let size = self.size.map(|side| side.clamp(*SIDE.start(), *SIDE.end()));
        let request = SaveRequest { kind: self.what, path, size, handles: self.handles };
        commands.push(WindowCommand::Save(request).into());
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
