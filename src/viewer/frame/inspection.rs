//! Drawer over the lower end of the panes: every number of the pinned texels.

use eframe::egui::{self, Rect, RichText};

use crate::jobs::displayed::Displayed;
use crate::model::Model;
use crate::model::inspection::{self, HEADS, Inspection};
use crate::model::material::loaded::LoadedMaterial;
use crate::model::view::ViewState;
use crate::widgets::readout::in_width;
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
pub fn drawer(ui: &mut egui::Ui, area: Rect, shown: Displayed<'_>, next: &mut Model) {
    let (pins, state) = (&shown.model.inspection.pins, &shown.model.view);
    let drawer = Drawer { pins, materials: shown.materials(), state };
    let height = drawer.height().min(SHARE * area.height());
    let over = area.with_min_y(area.bottom() - height);
    let drawn = egui::Area::new(ui.scope_id().with("drawer")).order(egui::Order::Middle).fixed_pos(over.min);
    drawn.constrain(false).show(ui.ctx(), |ui| {
        ui.set_clip_rect(over);
        let background = ui.allocate_rect(over, egui::Sense::click_and_drag()).rect;
        ui.painter().rect_filled(background, 0.0, ui.visuals().panel_fill);
        ui.scope_builder(egui::UiBuilder::new().max_rect(over.shrink(6.0)), |ui| {
            egui::ScrollArea::both().auto_shrink([false, false]).show(ui, |ui| {
                drawer.pins(ui, &mut next.inspection);
            });
        });
    });
}

/// What the drawer shows.
#[derive(Debug)]
struct Drawer<'a> {
    pins: &'a [[usize; 2]],
    materials: &'a [LoadedMaterial],
    state: &'a ViewState,
}

impl Drawer<'_> {
    /// The height of all contents.
    fn height(&self) -> f32 {
        let rows = (self.materials.len() + 1) as f32;
        46.0 + self.pins.len() as f32 * (19.0 * rows + 5.0)
    }

    fn pins(&self, ui: &mut egui::Ui, next: &mut Inspection) {
        ui.horizontal(|ui| {
            ui.strong("Pinned texels").on_hover_text("Computed in f64 under the light and view of now");
            if ui.small_button("Remove all pins").clicked() {
                next.pins.clear();
            }
        });
        for (number, pin) in self.pins.iter().enumerate() {
            let materials = self.materials.iter().map(LoadedMaterial::material);
            let rows = inspection::rows(materials, *pin, &self.state.scene, &self.state.convention());
            let grid = egui::Grid::new(("pin", number)).num_columns(HEADS.len() + 1);
            grid.min_col_width(0.0).spacing([SPACING, 2.0]).striped(true).show(ui, |ui| {
                self.pin_heading(ui, number, next);
                for (index, row) in rows.iter().enumerate() {
                    self.name(ui, index);
                    row.cells().iter().zip(WIDTHS).for_each(|(cell, width)| numbers(ui, cell, width));
                    ui.end_row();
                }
            });
        }
    }

    /// The names of the columns after the place of the pin.
    fn pin_heading(&self, ui: &mut egui::Ui, index: usize, next: &mut Inspection) {
        let pin = self.pins[index];
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

    fn name(&self, ui: &mut egui::Ui, index: usize) {
        let material = &self.materials[index];
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
}

/// The numbers of a cell, each in `width` characters; in full under the pointer.
fn numbers(ui: &mut egui::Ui, cell: &[f64], width: usize) {
    let text: Vec<String> = cell.iter().map(|value| in_width(*value, width, 3)).collect();
    let full: Vec<String> = cell.iter().map(f64::to_string).collect();
    let label = ui.label(RichText::new(text.join(" ")).monospace().size(NUMBERS));
    label.on_hover_text(full.join("\n"));
}
