//! The list of keys and gestures.

use eframe::egui::{self, RichText};

use crate::viewer::model::command::{Command, WindowCommand};
use crate::viewer::ui::input::keys;

/// The help window; closing it is a command.
pub fn ui(ctx: &egui::Context) -> Option<Command> {
    let mut open = true;
    let height = ctx.content_rect().height() - 90.0;
    egui::Window::new("Keys and mouse")
        .open(&mut open)
        .collapsible(false)
        .resizable(false)
        .anchor(egui::Align2::CENTER_CENTER, [0.0, 0.0])
        .show(ctx, |ui| {
            egui::ScrollArea::vertical().max_height(height).min_scrolled_height(height).show(ui, |ui| {
                egui::Grid::new("keys").num_columns(2).striped(true).show(ui, |ui| {
                    for (key, what) in keys::HELP {
                        ui.label(RichText::new(*key).monospace());
                        ui.label(*what);
                        ui.end_row();
                    }
                });
            });
        });
    (!open).then_some(WindowCommand::ShowHelp(false).into())
}
