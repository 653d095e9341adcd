//! Dialog that saves the view, the renderings, a strip, the session or the scenes of the loss.

use std::path::Path;

use eframe::egui::{self, RichText};

use crate::files::dialog::{dialog, path_field, problem};
use crate::jobs::Edit;
use crate::jobs::work::Job;
use crate::model::Model;
use crate::model::dialogs::{PathField, SaveDialog, SaveKind, SaveRequest};
use crate::model::{BrowseFor, Effect};
use crate::widgets::{progress, theme};

/// Draws the dialog, where it is open; `saving` is the file that is being written.
pub fn ui(ctx: &egui::Context, saving: Option<&Job<Edit>>, next: &mut Model) {
    let Some(mut state) = next.dialogs.save.take() else { return };
    let open = dialog(ctx, "Save", 420.0, |ui| contents(ui, &mut state, saving, next));
    next.dialogs.save = open.then_some(state);
}

fn contents(ui: &mut egui::Ui, state: &mut SaveDialog, saving: Option<&Job<Edit>>, next: &mut Model) {
    choice(ui, state, next.dataset.open.is_some());
    let field = path_field(ui, &mut state.field, "To file:", egui::TextEdit::singleline(&mut state.path));
    let entered = field.lost_focus() && ui.input(|i| i.key_pressed(egui::Key::Enter));
    ui.horizontal(|ui| {
        if ui.button("Browse...").on_hover_text("Chooses the file with the dialog of the system").clicked() {
            next.effects.push(Effect::Browse(BrowseFor::Saving));
        }
        let folder = std::path::absolute(state.path.trim()).ok();
        let folder = folder.as_deref().and_then(Path::parent).map(|folder| folder.display().to_string());
        let folder = folder.map(|folder| format!("in {folder}")).unwrap_or_default();
        ui.add(egui::Label::new(RichText::new(&folder).small().weak()).truncate()).on_hover_text(folder);
    });
    ui.label(RichText::new(state.what.explanation()).small().weak());
    let replaces = state.replaces.as_deref() == Some(state.path.trim());
    if let Some(job) = saving {
        written(ui, job);
    } else {
        ui.horizontal(|ui| {
            let button = ui.button(if replaces { "Replace it" } else { "Save file" });
            if std::mem::take(&mut state.focus_button) {
                button.request_focus();
            }
            if (button.on_hover_text("Return in the field").clicked() || entered)
                && let Some(path) = state.confirmed()
            {
                next.effects.push(Effect::Save(SaveRequest { kind: state.what, path }));
            }
            if replaces {
                ui.colored_label(theme::problem(ui.visuals()), "This file exists.");
            }
        });
    }
    problem(ui, &state.field);
}

/// What is saved; a name that was proposed follows.
fn choice(ui: &mut egui::Ui, state: &mut SaveDialog, has_dataset: bool) {
    ui.horizontal(|ui| {
        let of_dataset = SaveKind::OF_DATASET.into_iter().filter(|_| has_dataset);
        for what in SaveKind::ALL.into_iter().chain(of_dataset) {
            let button = ui.selectable_label(state.what == what, what.name());
            if button.on_hover_text(what.explanation()).clicked() {
                if SaveKind::ALL.iter().chain(&SaveKind::OF_DATASET).any(|kind| kind.proposal() == state.path)
                {
                    state.path = what.proposal().to_owned();
                }
                state.what = what;
                // Return saves.
                state.field = PathField::default();
            }
        }
    });
}

/// The progress of what is being written, in one line, and its end.
fn written(ui: &mut egui::Ui, job: &Job<Edit>) {
    ui.horizontal(|ui| {
        let cancel = ui.button("Cancel saving").on_hover_text("Stop; no file is written");
        if cancel.clicked() {
            job.cancel();
        }
        let text = format!("saving, {} s", job.elapsed().as_secs());
        progress(ui, job.fraction(), text).on_hover_text("It goes on when this dialog is closed");
    });
}
