//! Errors and what was done, until they are dismissed.

use eframe::egui;

use crate::viewer::command::Command;
use crate::viewer::theme;

/// The messages, the latest on top; dismissing them is a command.
pub fn ui(ui: &mut egui::Ui, messages: &[String]) -> Option<Command> {
    let mut dismissed = false;
    ui.horizontal_top(|ui| {
        dismissed = ui.button("Dismiss").clicked();
        egui::ScrollArea::vertical().max_height(110.0).show(ui, |ui| {
            ui.vertical(|ui| {
                for message in messages.iter().rev() {
                    let colour = if message.starts_with("Saved") {
                        ui.visuals().text_color()
                    } else {
                        theme::problem(ui.visuals())
                    };
                    ui.label(egui::RichText::new(message).color(colour));
                }
            });
        });
    });
    dismissed.then_some(Command::DismissMessage)
}
