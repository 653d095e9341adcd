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
pub mod study;
pub mod top;

use eframe::egui::{self, DragValue, Response, RichText};

use crate::files::read::{
    Albedo, Assumption, Certainty, Energy, Grid, NonFinite, NormalEncoding, NormalY, Order, Preset, ReadOptions,
    Reflectance, Roughness, What, Workflow,
};

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
/// `name` tells them from those of other materials. `assumptions` are those of the last reading: they say what was
/// found out, and why.
pub fn read_options(ui: &mut egui::Ui, name: &str, options: &mut ReadOptions, assumptions: &[Assumption]) {
    let found = |what| assumptions.iter().find(|a| a.what == what);
    let ReadOptions {
        preset,
        order,
        workflow,
        albedo,
        specular,
        normal_y,
        normal_encoding,
        roughness,
        energy,
        ..
    } = options;
    ui.horizontal_wrapped(|ui| {
        choice(ui, (name, "preset"), preset, &Preset::ALL, None);
        choice(ui, (name, "order"), order, &Order::ALL, found(What::Layout));
        choice(ui, (name, "workflow"), workflow, &Workflow::ALL, found(What::Workflow));
        choice(ui, (name, "albedo"), albedo, &Albedo::ALL, found(What::Albedo));
        choice(ui, (name, "specular"), specular, &Albedo::ALL, found(What::Specular));
        choice(ui, (name, "normal y"), normal_y, &NormalY::ALL, found(What::NormalY));
        choice(ui, (name, "normal encoding"), normal_encoding, &NormalEncoding::ALL, found(What::NormalEncoding));
        choice(ui, (name, "roughness"), roughness, &Roughness::ALL, found(What::Roughness));
        choice(ui, (name, "energy"), energy, &Energy::ALL, found(What::Energy));
        grid(ui, name, &mut options.grid);
        let mut f0 = options.dielectric.unwrap_or(Reflectance::DIELECTRIC).value();
        number(ui, &format!("F0 of {name}"), &mut f0, Reflectance::DIELECTRIC.value(), |drag| {
            drag.range(0.0..=1.0).speed(0.001).prefix("F0 ")
        })
        .on_hover_text("Reflectance at normal incidence of what is no metal, where no map says it");
        let f0 = Reflectance::try_from(f0).ok();
        options.dielectric = f0.filter(|f0| *f0 != Reflectance::DIELECTRIC);
        let exemplar = format!("exemplar of {name}");
        let mut number_of = options.exemplar.unwrap_or(0);
        number(ui, &exemplar, &mut number_of, 0, |drag| drag.range(0..=999).prefix("exemplar "))
            .on_hover_text("Which row of a packed picture, or which material of a file, from 0");
        options.exemplar = (number_of > 0).then_some(number_of);
        let mut replace = options.non_finite == Some(NonFinite::Replace);
        ui.checkbox(&mut replace, "replace NaN").on_hover_text("NaN and infinity: else they are an error");
        options.non_finite = replace.then_some(NonFinite::Replace);
        let mut flip = options.flip_v == Some(true);
        ui.checkbox(&mut flip, "flip rows").on_hover_text("Row 0 of every picture is the lowest one");
        options.flip_v = flip.then_some(true);
    });
}

/// How many columns and rows of tiles a packed picture has; 0 of either is to find it out.
fn grid(ui: &mut egui::Ui, name: &str, grid: &mut Option<Grid>) {
    let [mut columns, mut rows] = grid.map_or([0, 0], |g| [g.columns, g.rows]);
    let auto = |count: f64, _| if count < 1.0 { "auto".to_owned() } else { format!("{count:.0}") };
    let count = |ui: &mut egui::Ui, what: &str, value: &mut usize| {
        let name = format!("{what} of tiles of {name}");
        let hover = "A packed picture has this many tiles; 0 is to find it out";
        number(ui, &name, value, 0, |drag| {
            drag.range(0..=Grid::MOST).speed(0.05).prefix(format!("{what} ")).custom_formatter(auto)
        })
        .on_hover_text(hover)
        .changed()
    };
    if count(ui, "columns", &mut columns) | count(ui, "rows", &mut rows) {
        // One of them alone has one of the other.
        let was_auto = grid.is_none();
        let least = usize::from(was_auto);
        let both = Grid { columns: columns.max(least), rows: rows.max(least) };
        *grid = (both.columns > 0 && both.rows > 0).then_some(both);
    }
}

/// A drop-down for one assumption: `None` is to find it out.
fn choice<T: Copy + PartialEq + std::fmt::Display>(
    ui: &mut egui::Ui,
    (material, what): (&str, &str),
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
    let text = RichText::new(format!("{what} {chosen}"));
    let text = if unsure { text.color(ui.visuals().warn_fg_color) } else { text };
    let response = egui::ComboBox::from_id_salt((material, what)).selected_text(text).show_ui(ui, |ui| {
        ui.selectable_value(value, None, format!("auto: find out {what}"));
        for one in all {
            ui.selectable_value(value, Some(*one), format!("{what} {one}"));
        }
    });
    let name = format!("{what} of {material}");
    response.response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::ComboBox, true, &name));
    let why = found.map_or_else(|| "Nothing is known of it".to_owned(), ToString::to_string);
    response.response.on_hover_text(why);
}
