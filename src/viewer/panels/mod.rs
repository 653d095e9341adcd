//! The parts of the window around the panes. Each draws what it is given and returns what a person did.

pub mod help;
pub mod loss;
mod loss_results;
pub mod materials;
pub mod messages;
pub mod open;
pub mod save;
pub mod scene;
pub mod status;
pub mod top;

use eframe::egui::{self, DragValue, Response, RichText};

use crate::material::read::{Albedo, Assumption, Certainty, NormalY, Order, ReadOptions, Roughness, What};

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

/// Drop-downs for how a material's files are to be understood; of each the first choice is to find it out.
///
/// `assumptions` are those of the last reading: they say what was found out, and why.
pub fn read_options(ui: &mut egui::Ui, name: &str, options: &mut ReadOptions, assumptions: &[Assumption]) {
    let found = |what| assumptions.iter().find(|a| a.what == what);
    ui.horizontal_wrapped(|ui| {
        choice(ui, (name, "order"), &mut options.order, &Order::ALL, found(What::Layout));
        choice(ui, (name, "albedo"), &mut options.albedo, &Albedo::ALL, found(What::Albedo));
        choice(ui, (name, "specular"), &mut options.specular, &Albedo::ALL, found(What::Specular));
        choice(ui, (name, "normal"), &mut options.normal_y, &NormalY::ALL, found(What::NormalY));
        choice(ui, (name, "roughness"), &mut options.roughness, &Roughness::ALL, found(What::Roughness));
    });
}

/// A drop-down for one assumption: `None` is to find it out.
fn choice<T: Copy + PartialEq + std::fmt::Display>(
    ui: &mut egui::Ui,
    id: (&str, &str),
    value: &mut Option<T>,
    all: &[T],
    found: Option<&Assumption>,
) {
    let chosen = match (*value, found) {
        (Some(value), _) => value.to_string(),
        (None, Some(found)) if found.what == What::Layout => "auto".to_owned(),
        (None, Some(found)) => format!("auto ({})", found.chosen),
        (None, None) => "auto".to_owned(),
    };
    let unsure = found.is_some_and(|f| f.certainty == Certainty::Unsure);
    let text = RichText::new(format!("{} {chosen}", id.1));
    let text = if unsure { text.color(ui.visuals().warn_fg_color) } else { text };
    let response = egui::ComboBox::from_id_salt(id).selected_text(text).show_ui(ui, |ui| {
        ui.selectable_value(value, None, format!("auto: find out {}", id.1));
        for one in all {
            ui.selectable_value(value, Some(*one), format!("{} {one}", id.1));
        }
    });
    let why = found.map_or_else(|| "Not known yet".to_owned(), ToString::to_string);
    response.response.on_hover_text(why);
}
