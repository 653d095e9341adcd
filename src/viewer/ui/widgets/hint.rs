//! Hints: texts in the panes.

use eframe::egui::{self, Align2, FontId, Rect, vec2};

/// A text at the bottom of a pane.
pub fn paint_hint(painter: &egui::Painter, rect: Rect, text: &str) {
    let (font, ink) = (FontId::proportional(13.0), egui::Color32::from_gray(235));
    let galley = painter.layout(text.to_owned(), font, ink, (rect.width() - 24.0).max(40.0));
    let place = Align2::CENTER_BOTTOM.anchor_size(rect.center_bottom() - vec2(0.0, 10.0), galley.size());
    painter.rect_filled(place.expand2(vec2(8.0, 4.0)), 4.0, egui::Color32::from_black_alpha(170));
    painter.galley(place.min, galley, ink);
}

/// A text in the middle of an empty area.
pub fn note(ui: &egui::Ui, area: Rect, text: &str) {
    let galley = ui.painter().layout(
        text.to_owned(),
        FontId::proportional(15.0),
        egui::Color32::from_gray(235),
        area.width() * 0.8,
    );
    let rect = Align2::CENTER_CENTER.anchor_size(area.center(), galley.size());
    ui.painter().galley(rect.min, galley, egui::Color32::from_gray(235));
}
