//! Dialog that opens materials: by path, by the system's file dialog, or from the recent ones.

use std::path::{Path, PathBuf};

use eframe::egui::{self, RichText};

use svbrdf_files::read::ReadOptions;
use svbrdf_files::session::Session;

use crate::files::dialog::{dialog, path_field, problem};
use crate::model::dialogs::{OpenDialog, Opens};
use crate::model::material::read::file_name;
use crate::model::{BrowseFor, Effect};
use crate::model::{Model, opening};

/// Height below the list of recent materials, and least height of the list.
const BELOW_RECENT: f32 = 230.0;
const LEAST_RECENT: f32 = 60.0;

/// Most names of a recent comparison after the first.
const MOST_NAMES: usize = 8;

/// Draws the dialog, where it is open.
pub fn ui(ctx: &egui::Context, next: &mut Model) {
    let Some(mut state) = next.dialogs.open.take() else { return };
    let (mut submits, mut reopens) = (false, None);
    let open = dialog(ctx, "Open materials", 460.0, |ui| {
        let entered = fields(ui, &mut state, &mut next.effects);
        // The buttons stay visible, however long the list is.
        let room = ui.ctx().content_rect().bottom() - ui.cursor().top() - BELOW_RECENT;
        egui::ScrollArea::vertical()
            .max_height(room.max(LEAST_RECENT))
            .show(ui, |ui| reopens = recent_comparisons(ui, &next.recent));
        ui.separator();
        submits = choices(ui, &mut state, entered);
        problem(ui, &state.field);
    });
    let (paths, opens) = (state.paths(), state.opens);
    next.dialogs.open = open.then_some(state);
    if let Some(index) = reopens {
        opening::reopen(next, index);
    }
    if submits {
        match opens {
            Opens::Dataset => next.effects.push(Effect::OpenDataset(paths)),
            Opens::Photograph => opening::open_photograph(next, paths[0].clone()),
            opens => opening::open(next, paths, opens == Opens::Comparison, ReadOptions::AUTO),
        }
    }
}

/// The field of the paths; whether Return was pressed in it.
fn fields(ui: &mut egui::Ui, state: &mut OpenDialog, effects: &mut Vec<Effect>) -> bool {
    let new_line = egui::KeyboardShortcut::new(egui::Modifiers::SHIFT, egui::Key::Enter);
    let field = egui::TextEdit::multiline(&mut state.text)
        .desired_rows(3)
        .hint_text("materials/brick.png")
        .return_key(new_line);
    let label = "Files, folders or name prefixes, one a line:";
    let field = path_field(ui, &mut state.field, label, field);
    let entered =
        field.has_focus() && ui.input_mut(|i| i.consume_key(egui::Modifiers::NONE, egui::Key::Enter));
    field.on_hover_text("Return opens them; Shift + Return begins a new line");
    ui.horizontal(|ui| {
        for (what, text, hover) in [
            (BrowseFor::Files, "Browse files...", "Adds files with the file dialog of the system"),
            (BrowseFor::Folders, "Browse folders...", "Adds folders, each with the maps of one material"),
        ] {
            if ui.button(text).on_hover_text(hover).clicked() {
                effects.push(Effect::Browse(what));
            }
        }
    });
    entered
}

/// What the paths are, and the button that opens them; whether it is pressed.
fn choices(ui: &mut egui::Ui, state: &mut OpenDialog, entered: bool) -> bool {
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
        ui.radio_value(&mut state.opens, opens, text).on_hover_text(hover);
    }
    let ready = !state.paths().is_empty() && !state.submitted;
    let text = if state.submitted { "Reading..." } else { "Open these" };
    let button = ui.add_enabled(ready, egui::Button::new(text)).on_disabled_hover_text("Needs a path above");
    let entered = entered || ui.input_mut(|i| i.consume_key(egui::Modifiers::COMMAND, egui::Key::Enter));
    let submits = button.on_hover_text("Return in the field, or Ctrl+Return").clicked() || (entered && ready);
    if submits {
        state.submitted = true;
        state.field.problem = None;
    }
    submits
}

/// The last comparisons; the one that is clicked, to be opened as it was shown.
fn recent_comparisons(ui: &mut egui::Ui, recent: &[Session]) -> Option<usize> {
    if recent.is_empty() {
        return None;
    }
    let mut clicked = None;
    ui.label(RichText::new("Recent comparisons").weak());
    for (index, session) in recent.iter().enumerate() {
        let paths = paths(session);
        let button = egui::Button::selectable(false, compared(&paths)).truncate();
        let key = if index == 0 { " (Ctrl+Shift+O)" } else { "" };
        let paths: Vec<String> = paths.iter().map(|path| path.display().to_string()).collect();
        let hover = format!("Opens these as they were shown{key}:\n{}", paths.join("\n"));
        if ui.add(button).on_hover_text(hover).clicked() {
            clicked = Some(index);
        }
    }
    clicked
}

/// The files of a comparison, the ground truth first.
fn paths(session: &Session) -> Vec<&Path> {
    match &session.dataset {
        Some(dataset) => dataset.paths().map(PathBuf::as_path).collect(),
        None => {
            let built_in = Path::new("built-in material");
            session.materials.iter().map(|one| one.place.path().unwrap_or(built_in)).collect()
        }
    }
}

/// The names of these files; of many, their number.
fn compared(paths: &[&Path]) -> String {
    let names: Vec<String> = paths.iter().map(|path| file_name(path)).collect();
    match names.split_first() {
        Some((first, others)) if others.len() > MOST_NAMES => format!("{first} | {} others", others.len()),
        Some((first, others)) if !others.is_empty() => format!("{first} | {}", others.join(", ")),
        _ => names.concat(),
    }
}
