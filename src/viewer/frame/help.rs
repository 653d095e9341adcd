//! The list of keys and gestures.

use eframe::egui::{self, RichText};

use crate::frame::actions::{HELP, Line};

/// Width of the keys and of the list, in points.
const KEYS: f32 = 190.0;
const WIDTH: f32 = 560.0;

/// The help window, while it is `open`.
pub fn ui(ctx: &egui::Context, open: &mut bool) {
    let room = ctx.content_rect().size();
    egui::Window::new("Keys and mouse")
        .open(open)
        .collapsible(false)
        .resizable(false)
        .anchor(egui::Align2::CENTER_CENTER, [0.0, 0.0])
        .show(ctx, |ui| {
            ui.set_width(WIDTH.min((room.x - 40.0).max(0.0)));
            egui::ScrollArea::vertical().max_height((room.y - 100.0).max(0.0)).show(ui, |ui| {
                for (name, lines) in HELP {
                    ui.strong(*name);
                    lines.iter().for_each(|one| help_line(ui, one));
                    ui.add_space(8.0);
                }
            });
        });
}

/// A line laid out by itself: a grid measures its rows for a frame, in which keys stand beside effects of others.
fn help_line(ui: &mut egui::Ui, line: &Line) {
    ui.horizontal_top(|ui| {
        ui.allocate_ui(egui::vec2(KEYS, 0.0), |ui| {
            ui.set_width(KEYS);
            ui.add(egui::Label::new(RichText::new(line.keys).monospace().size(11.5)).wrap());
        });
        ui.add(egui::Label::new(line.effect).wrap());
    });
}
