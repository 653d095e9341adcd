//! Widgets and formats that several parts of the window share.

pub mod hint;
pub mod names;
pub mod numbers;
pub mod plot;
pub mod read_options;
pub mod readout;
pub mod texture;
pub mod theme;

use eframe::egui::{self, DragValue, Response};

/// A number to drag or type; a double-click resets it to `default`.
///
/// `name` is its accessible name.
pub fn number<T: egui::emath::Numeric>(
    ui: &mut egui::Ui,
    name: &str,
    value: &mut T,
    default: T,
    shape: impl FnOnce(DragValue<'_>) -> DragValue<'_>,
) -> Response {
    let before = *value;
    let response = ui.add(shape(DragValue::new(value)));
    response.widget_info(|| {
        let mut info = egui::WidgetInfo::labeled(egui::Role::SpinButton, true, name);
        info.value = Some(before.to_f64());
        info
    });
    if response.double_clicked() {
        *value = default;
        ui.memory_mut(|m| m.surrender_focus(response.id));
    }
    response
}
