//! Errors and results, until they are dismissed.

use eframe::egui;

use crate::viewer::command::{Command, WindowCommand};
use crate::viewer::message::{Message, Severity};
use crate::viewer::theme;

/// The messages, the latest on top; dismissing them is a command.
pub fn ui(ui: &mut egui::Ui, messages: &[Message]) -> Option<Command> {
    let mut dismissed = false;
    ui.horizontal_top(|ui| {
        dismissed = ui.button("Dismiss").clicked();
        egui::ScrollArea::vertical().max_height(110.0).show(ui, |ui| {
            ui.vertical(|ui| {
                for message in messages.iter().rev() {
                    let colour = match message.severity() {
                        Severity::Success => ui.visuals().text_color(),
                        Severity::Warning => ui.visuals().warn_fg_color,
                        Severity::Error => theme::problem(ui.visuals()),
                    };
                    ui.label(egui::RichText::new(message.to_string()).color(colour));
                }
            });
        });
    });
    dismissed.then_some(WindowCommand::DismissMessages.into())
}
