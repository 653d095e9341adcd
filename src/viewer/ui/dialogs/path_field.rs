//! Path field of a dialog, and the frame of a dialog.

use eframe::egui::{self, RichText};

use crate::ui::widgets::theme;

/// The path field of a dialog, and what went wrong with the path.
#[derive(Debug, Default)]
pub struct PathField {
    problem: Option<String>,
    /// Whether the field has been given the focus.
    focused: bool,
}

impl PathField {
    /// Shows what went wrong, and puts the cursor into the field.
    pub fn fail(&mut self, problem: String) {
        *self = Self { problem: Some(problem), focused: false };
    }

    /// Forgets what went wrong, before another attempt.
    pub fn clear(&mut self) {
        self.problem = None;
    }

    /// The field below its label. It has the focus at first.
    pub fn ui(&mut self, ui: &mut egui::Ui, label: &str, field: egui::TextEdit<'_>) -> egui::Response {
        let label = ui.label(label);
        let field = ui.add(field.desired_width(f32::INFINITY)).labelled_by(label.id);
        if !std::mem::replace(&mut self.focused, true) {
            field.request_focus();
        }
        if field.changed() {
            self.problem = None;
        }
        field
    }

    /// What went wrong, at the end of the dialog: nothing moves where it comes and goes.
    pub fn problem(&self, ui: &mut egui::Ui) {
        if let Some(problem) = &self.problem {
            ui.label(RichText::new(problem).color(theme::problem(ui.visuals())));
        }
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
