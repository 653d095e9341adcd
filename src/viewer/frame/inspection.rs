//! Drawer over the lower end of the panes: every number of the pinned texels.

use eframe::egui::{self, Rect, RichText};

use crate::model::Model;
use crate::model::inspection::{self, HEADS, Inspection};
use crate::model::material::loaded::LoadedMaterial;
use crate::pane::Displayed;
use crate::widgets::numbers::in_width;
use crate::widgets::theme;

/// Width of a name, and between columns, in points.
const NAME: f32 = 110.0;
const SPACING: f32 = 8.0;
/// The share of the height that the drawer takes at most.
const SHARE: f32 = 0.4;
/// Size of the numbers, in points.
const NUMBERS: f32 = 11.0;
/// Characters of a number in the columns of [`HEADS`].
const WIDTHS: [usize; HEADS.len()] = [6, 6, 6, 6, 6, 7, 7, 6, 6, 6, 6, 6, 6, 6];

/// The drawer over the lower end of the panes in `area`, which stay where they are.
pub fn drawer(ui: &mut egui::Ui, area: Rect, shown: &Displayed<'_>, next: &mut Model) {
    let rows = (shown.materials().len() + 1) as f32;
    let height = 46.0 + shown.model.inspection.pins.len() as f32 * (19.0 * rows + 5.0);
    let over = area.with_min_y(area.bottom() - height.min(SHARE * area.height()));
    let drawn = egui::Area::new(ui.scope_id().with("drawer")).order(egui::Order::Middle).fixed_pos(over.min);
    drawn.constrain(false).show(ui.ctx(), |ui| {
        ui.set_clip_rect(over);
        let background = ui.allocate_rect(over, egui::Sense::click_and_drag()).rect;
        ui.painter().rect_filled(background, 0.0, ui.visuals().panel_fill);
        ui.scope_builder(egui::UiBuilder::new().max_rect(over.shrink(6.0)), |ui| {
            egui::ScrollArea::both().auto_shrink([false, false]).show(ui, |ui| {
                pins(ui, shown, &mut next.inspection);
            });
        });
    });
}

fn pins(ui: &mut egui::Ui, shown: &Displayed<'_>, next: &mut Inspection) {
    ui.horizontal(|ui| {
        ui.strong("Pinned texels").on_hover_text("Computed in f64 under the light and view of now");
        if ui.small_button("Remove all pins").clicked() {
            next.pins.clear();
        }
    });
    for (number, pin) in shown.model.inspection.pins.iter().enumerate() {
        let materials = shown.materials().iter().map(LoadedMaterial::material);
        let rows = inspection::rows(materials, *pin, &shown.view().scene, &shown.view().convention());
        let grid = egui::Grid::new(("pin", number)).num_columns(HEADS.len() + 1);
        grid.min_col_width(0.0).spacing([SPACING, 2.0]).striped(true).show(ui, |ui| {
            heading(ui, number, *pin, next);
            for (material, row) in shown.materials().iter().zip(&rows) {
                name(ui, material);
                row.cells().iter().zip(WIDTHS).for_each(|(cell, width)| numbers(ui, cell, width));
                ui.end_row();
            }
        });
    }
}

/// The names of the columns after the place of the pin.
fn heading(ui: &mut egui::Ui, index: usize, pin: [usize; 2], next: &mut Inspection) {
    ui.horizontal(|ui| {
        ui.set_min_width(NAME);
        let name = format!("{}: {},{}", index + 1, pin[0], pin[1]);
        let button = ui.small_button(RichText::new(&name).monospace());
        if button.on_hover_text("Remove this pin").clicked() {
            next.toggle_pin(pin);
        }
    });
    for (name, meaning) in HEADS {
        ui.label(RichText::new(name).small().weak()).on_hover_text(meaning);
    }
    ui.end_row();
}

fn name(ui: &mut egui::Ui, material: &LoadedMaterial) {
    let text = format!("{}  {}", material.number(), material.name());
    let colour = match material.slot {
        0 => theme::ground_truth(ui.visuals()),
        slot => theme::series(slot, ui.visuals().dark_mode),
    };
    ui.scope(|ui| {
        ui.set_max_width(NAME);
        ui.add(egui::Label::new(RichText::new(text).small().color(colour)).truncate());
    });
}

/// The numbers of a cell, each in `width` characters; in full under the pointer.
fn numbers(ui: &mut egui::Ui, cell: &[f64], width: usize) {
    let text: Vec<String> = cell.iter().map(|value| in_width(*value, width, 3)).collect();
    let full: Vec<String> = cell.iter().map(f64::to_string).collect();
    let label = ui.label(RichText::new(text.join(" ")).monospace().size(NUMBERS));
    label.on_hover_text(full.join("\n"));
}
