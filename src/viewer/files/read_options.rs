//! Choices of how a material is read: a drop-down for each assumption.

use eframe::egui::{self, RichText};

use svbrdf_files::read::{
    Albedo, Assumption, Certainty, Energy, NonFinite, NormalEncoding, NormalY, Order, Preset, ReadOptions,
    Reflectance, Roughness, TileGrid, What, Workflow,
};

use crate::widgets::{named, number};

/// Drop-downs for the assumptions in reading a material; the first choice of each infers it from the files.
///
/// `name` is the material's, unique in the window. `assumptions` are those of the last reading: what was inferred, and
/// why.
pub fn read_options(ui: &mut egui::Ui, name: &str, options: &mut ReadOptions, assumptions: &[Assumption]) {
    let inferred = |what| assumptions.iter().find(|a| a.what == what);
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
    choice(ui, (name, "preset"), preset, &Preset::ALL, None);
    ui.horizontal_wrapped(|ui| {
        choice(ui, (name, "order"), order, &Order::ALL, inferred(What::Layout));
        choice(ui, (name, "workflow"), workflow, &Workflow::ALL, inferred(What::Workflow));
        choice(ui, (name, "albedo"), albedo, &Albedo::ALL, inferred(What::Albedo));
        choice(ui, (name, "specular"), specular, &Albedo::ALL, inferred(What::Specular));
        choice(ui, (name, "normal y"), normal_y, &NormalY::ALL, inferred(What::NormalY));
        choice(
            ui,
            (name, "normal encoding"),
            normal_encoding,
            &NormalEncoding::ALL,
            inferred(What::NormalEncoding),
        );
        choice(ui, (name, "roughness"), roughness, &Roughness::ALL, inferred(What::Roughness));
        choice(ui, (name, "energy"), energy, &Energy::ALL, inferred(What::Energy));
        grid(ui, name, &mut options.grid);
        let mut f0 = options.dielectric.unwrap_or(Reflectance::DIELECTRIC).value();
        number(ui, &format!("F0 of {name}"), &mut f0, Reflectance::DIELECTRIC.value(), |drag| {
            drag.range(0.0..=1.0).speed(0.001).prefix("F0 ")
        })
        .on_hover_text("Reflectance of dielectrics at normal incidence, where no map specifies it");
        let f0 = Reflectance::try_from(f0).ok();
        options.dielectric = f0.filter(|f0| *f0 != Reflectance::DIELECTRIC);
        let exemplar = format!("exemplar of {name}");
        let mut number_of = options.exemplar.unwrap_or(0);
        let before = number_of;
        number(ui, &exemplar, &mut number_of, 0, |drag| drag.range(0..=999).prefix("exemplar "))
            .on_hover_text("Row of a packed image, or material of a file, counted from 0");
        if number_of != before {
            options.exemplar = (number_of > 0).then_some(number_of);
        }
        let mut replace = options.non_finite == Some(NonFinite::Replace);
        ui.checkbox(&mut replace, "replace NaN")
            .on_hover_text("Replace NaN and infinity; otherwise they are an error");
        options.non_finite = replace.then_some(NonFinite::Replace);
        let mut flip = options.flip_v == Some(true);
        ui.checkbox(&mut flip, "flip rows").on_hover_text("The first row of every image is the bottom one");
        options.flip_v = flip.then_some(true);
    });
}

/// Columns and rows of tiles of a packed image; 0 of either infers them.
fn grid(ui: &mut egui::Ui, name: &str, grid: &mut Option<TileGrid>) {
    let [mut columns, mut rows] = grid.map_or([0, 0], |g| [g.columns, g.rows]);
    let auto = |count: f64, _| if count < 1.0 { "auto".to_owned() } else { format!("{count:.0}") };
    let count = |ui: &mut egui::Ui, what: &str, value: &mut usize| {
        let name = format!("{what} of tiles of {name}");
        let hover = format!("Tile {what} of a packed image; 0 infers them");
        number(ui, &name, value, 0, |drag| {
            drag.range(0..=TileGrid::MOST).speed(0.05).prefix(format!("{what} ")).custom_formatter(auto)
        })
        .on_hover_text(hover)
        .changed()
    };
    if count(ui, "columns", &mut columns) | count(ui, "rows", &mut rows) {
        // One of them specified alone implies one of the other.
        let was_auto = grid.is_none();
        let least = usize::from(was_auto);
        let both = TileGrid { columns: columns.max(least), rows: rows.max(least) };
        *grid = (both.columns > 0 && both.rows > 0).then_some(both);
    }
}

/// A drop-down for one assumption; `None` infers it.
fn choice<T: Copy + PartialEq + std::fmt::Display>(
    ui: &mut egui::Ui,
    (material, what): (&str, &str),
    value: &mut Option<T>,
    all: &[T],
    inferred: Option<&Assumption>,
) {
    let chosen = match (*value, inferred) {
        (Some(value), _) => value.to_string(),
        (None, Some(inferred)) if inferred.what == What::Layout => "auto".to_owned(),
        (None, Some(inferred)) => format!("auto ({})", inferred.chosen),
        (None, None) => "auto".to_owned(),
    };
    let unsure = inferred.is_some_and(|a| a.certainty == Certainty::Unsure);
    let text = RichText::new(format!("{what} {chosen}"));
    let text = if unsure { text.color(ui.visuals().warn_fg_color) } else { text };
    let response = egui::ComboBox::from_id_salt((material, what)).selected_text(text).show_ui(ui, |ui| {
        ui.selectable_value(value, None, format!("auto: infer {what}"));
        for one in all {
            ui.selectable_value(value, Some(*one), format!("{what} {one}"));
        }
    });
    named(&response.response, &format!("{what} of {material}"));
    let why = inferred.map_or_else(|| "Nothing was inferred".to_owned(), ToString::to_string);
    response.response.on_hover_text(why);
}
