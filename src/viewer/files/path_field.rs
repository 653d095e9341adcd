//! Path field of a dialog, and the frame of a dialog.

use eframe::egui::{self, RichText};

use crate::model::dialogs::PathField;
use crate::widgets::theme;

/// The field below its label. It has the focus at first.
pub fn path_field(
    ui: &mut egui::Ui,
    state: &mut PathField,
    label: &str,
    field: egui::TextEdit<'_>,
) -> egui::Response {
    let label = ui.label(label);
    let field = ui.add(field.desired_width(f32::INFINITY)).labelled_by(label.id);
    if !std::mem::replace(&mut state.focused, true) {
        field.request_focus();
    }
    if field.changed() {
        state.problem = None;
    }
    field
}

/// What went wrong, at the end of the dialog: nothing moves where it comes and goes.
pub fn problem(ui: &mut egui::Ui, state: &PathField) {
    if let Some(problem) = &state.problem {
        ui.label(RichText::new(problem).color(theme::problem(ui.visuals())));
    }
}

/// A dialog at the top of the window; false where it was closed.
pub fn dialog(ctx: &egui::Context, title: &str, width: f32, contents: impl FnOnce(&mut egui::Ui)) -> bool {
    let mut open = true;
    egui::Window::new(title)
        .open(&mut open)
        .collapsible(false)
        .default_width(width)
        .anchor(egui::Align2::CENTER_TOP, [0.0, 40.0])
        .show(ctx, contents);
    open
}
