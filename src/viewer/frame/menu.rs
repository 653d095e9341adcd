//! The menu of the bar: what is seldom used.

use eframe::egui;

use crate::model::Model;

/// The scales of text and controls that the menu offers, in percent.
const SCALES: [u16; 8] = [75, 100, 125, 150, 175, 200, 250, 300];

pub fn ui(ui: &mut egui::Ui, model: &Model, next: &mut Model) {
    if let Some(open) = &model.dataset.open {
        of_dataset(ui, open.noun(), next);
        ui.separator();
    }
    let theme = if model.settings.dark { "Light theme" } else { "Dark theme" };
    if ui.button(theme).on_hover_text("Colours of the window").clicked() {
        next.settings.dark ^= true;
        ui.close();
    }
    let scales = ui.menu_button("UI scale", |ui| {
        for percent in SCALES {
            let scale = f32::from(percent) / 100.0;
            let is_current = (model.settings.ui_scale - scale).abs() < 1e-3;
            if ui.selectable_label(is_current, format!("{percent}%")).clicked() {
                ui.ctx().set_zoom_factor(scale);
                ui.close();
            }
        }
    });
    let hover = "Size of text and controls (Ctrl with plus, minus)";
    scales.response.on_hover_text(hover);
}

/// The parts of the window that only a data set has; `noun` is what it lists.
fn of_dataset(ui: &mut egui::Ui, noun: &str, next: &mut Model) {
    let dataset = &mut next.dataset;
    ui.toggle_value(&mut dataset.list.is_open, format!("List of {noun}s  (A)"))
        .on_hover_text("Beside the panes");
}
