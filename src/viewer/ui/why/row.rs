//! Row of the section of the diagnosis.

use eframe::egui::{self, Rect, Sense, vec2};

/// Height of a row, in points.
const ROW: f32 = 17.0;

/// A row, drawn without its text.
#[derive(Debug)]
pub struct Row {
    /// What it is called.
    pub label: String,
    pub selected: bool,
}

impl Row {
    /// The row with its area; a label where it is no button.
    pub fn ui(self, ui: &mut egui::Ui, is_button: bool) -> (egui::Response, Rect) {
        let sense = if is_button { Sense::click() } else { Sense::hover() };
        let (area, response) = ui.allocate_exact_size(vec2(ui.available_width(), ROW), sense);
        let role = if is_button { egui::Role::Button } else { egui::Role::Label };
        response.widget_info(|| egui::WidgetInfo::selected(role, true, self.selected, &self.label));
        let (visuals, painter) = (ui.visuals(), ui.painter());
        if self.selected {
            painter.rect_filled(area, 3.0, visuals.selection.bg_fill);
        } else if is_button && response.hovered() {
            painter.rect_filled(area, 3.0, visuals.widgets.hovered.weak_bg_fill);
        }
        if response.has_focus() {
            painter.rect_stroke(area, 3.0, visuals.selection.stroke, egui::StrokeKind::Inside);
        }
        (response, area)
    }
}
