//! The parts of the window around the panes. Each draws what it is given and returns what a person did.

pub mod help;
pub mod loss;
pub mod materials;
pub mod messages;
pub mod open;
pub mod save;
pub mod scene;
pub mod status;
pub mod top;

use eframe::egui::{self, DragValue, Response};

use crate::material::read::{Albedo, NormalY, ReadOptions};

/// A number that can be dragged and typed; a double-click puts back its `default`.
///
/// `name` is what screen readers and tests call it.
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

/// Drop-downs for how a material's files are to be understood.
pub fn read_options(ui: &mut egui::Ui, name: &str, options: &mut ReadOptions) {
    ui.horizontal_wrapped(|ui| {
        egui::ComboBox::from_id_salt((name, "albedo"))
            .selected_text(format!("albedo {}", options.albedo))
            .show_ui(ui, |ui| {
                for albedo in Albedo::ALL {
                    ui.selectable_value(&mut options.albedo, albedo, albedo.to_string());
                }
            })
            .response
            .on_hover_text("How diffuse and specular are stored: this changes every rendering and loss");
        egui::ComboBox::from_id_salt((name, "normal"))
            .selected_text(match options.normal_y {
                NormalY::Up => "normal +Y",
                NormalY::Down => "normal -Y",
            })
            .show_ui(ui, |ui| {
                ui.selectable_value(&mut options.normal_y, NormalY::Up, "+Y (up, OpenGL)");
                ui.selectable_value(&mut options.normal_y, NormalY::Down, "-Y (down, DirectX)");
            })
            .response
            .on_hover_text("Which way the green channel of the normal map points");
    });
}
