//! Drawer over the lower end of the panes: every number of the pinned texels.

use std::ops::Range;

use eframe::egui::{self, FontId, Rect, RichText, TextStyle};

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
/// Which columns of [`HEADS`] have three numbers.
const COLOURS: [usize; 5] = [0, 1, 2, 4, 7];
/// The column from which on a second table has the columns where one is too wide: the terms of the rendering.
const TERMS: usize = 5;

/// The drawer over the lower end of the panes in `area`, which stay where they are.
pub fn drawer(ui: &mut egui::Ui, area: Rect, shown: Displayed<'_>, next: &mut Model) {
    let (pins, state) = (&shown.model.inspection.pins, &shown.model.view);
    let drawer = Drawer { pins, materials: shown.materials(), state };
    let tables = tables(ui);
    let height = drawer.height(tables.len()).min(SHARE * area.height());
    let over = area.with_min_y(area.bottom() - height);
    let drawn = egui::Area::new(ui.scope_id().with("drawer")).order(egui::Order::Middle).fixed_pos(over.min);
    drawn.constrain(false).show(ui.ctx(), |ui| {
        ui.set_clip_rect(over);
        let background = ui.allocate_rect(over, egui::Sense::click_and_drag()).rect;
        ui.painter().rect_filled(background, 0.0, ui.visuals().panel_fill);
        ui.scope_builder(egui::UiBuilder::new().max_rect(over.shrink(6.0)), |ui| {
            egui::ScrollArea::both().auto_shrink([false, false]).show(ui, |ui| {
                drawer.pins(ui, &tables, &mut next.inspection);
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
    fn height(&self, tables: usize) -> f32 {
        let rows = (self.materials.len() + 1) as f32;
        46.0 + self.pins.len() as f32 * tables as f32 * (19.0 * rows + 5.0)
    }

    fn pins(&self, ui: &mut egui::Ui, tables: &[Range<usize>], next: &mut Inspection) {
        ui.horizontal(|ui| {
            ui.strong("Pinned texels").on_hover_text("Computed in f64 under the light and view of now");
            if ui.small_button("Remove all pins").clicked() {
                next.pins.clear();
            }
        });
        for (number, pin) in self.pins.iter().enumerate() {
            let materials = self.materials.iter().map(LoadedMaterial::material);
            let rows = inspection::rows(materials, *pin, &self.state.scene, &self.state.convention());
            for columns in tables {
                let grid = egui::Grid::new(("pin", number, columns.start)).num_columns(columns.len() + 1);
                grid.min_col_width(0.0).spacing([SPACING, 2.0]).striped(true).show(ui, |ui| {
                    self.pin_heading(ui, number, columns, next);
                    for (index, row) in rows.iter().enumerate() {
                        self.name(ui, index);
                        row.cells()[columns.clone()].iter().zip(columns.clone()).for_each(
                            |(cell, column)| {
                                numbers(ui, cell, WIDTHS[column]);
                            },
                        );
                        ui.end_row();
                    }
                });
            }
        }
    }

    /// The names of the columns; before those of the first table, the place of the pin.
    fn pin_heading(&self, ui: &mut egui::Ui, index: usize, columns: &Range<usize>, next: &mut Inspection) {
        let pin = self.pins[index];
        ui.horizontal(|ui| {
            ui.set_min_width(NAME);
            if columns.start == 0 {
                let name = format!("{}: {},{}", index + 1, pin[0], pin[1]);
                let button = ui.small_button(RichText::new(&name).monospace());
                if button.on_hover_text("Remove this pin").clicked() {
                    next.toggle_pin(pin);
                }
            }
        });
        for (name, meaning) in &HEADS[columns.clone()] {
            ui.label(RichText::new(*name).small().weak()).on_hover_text(*meaning);
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

/// The columns of each table of pins: of one where it fits into the width, otherwise of two below each other.
fn tables(ui: &egui::Ui) -> Vec<Range<usize>> {
    let all = 0..HEADS.len();
    let small = TextStyle::Small.resolve(ui.style());
    let needed = ui.fonts_mut(|fonts| {
        let glyph = fonts.glyph_width(&FontId::monospace(NUMBERS), '0');
        let columns = all.clone().map(|column| {
            let count = if COLOURS.contains(&column) { 3 * WIDTHS[column] + 2 } else { WIDTHS[column] };
            let name: f32 = HEADS[column].0.chars().map(|c| fonts.glyph_width(&small, c)).sum();
            name.max(glyph * count as f32) + SPACING
        });
        NAME + columns.sum::<f32>()
    });
    let room = ui.available_width() - ui.spacing().scroll.allocated_width();
    if needed <= room { vec![all] } else { vec![0..TERMS, TERMS..HEADS.len()] }
}

/// The numbers of a cell, each in `width` characters; in full under the pointer.
fn numbers(ui: &mut egui::Ui, cell: &[f64], width: usize) {
    let text: Vec<String> = cell.iter().map(|value| in_width(*value, width, 3)).collect();
    let full: Vec<String> = cell.iter().map(f64::to_string).collect();
    let label = ui.label(RichText::new(text.join(" ")).monospace().size(NUMBERS));
    label.on_hover_text(full.join("\n"));
}
