//! Drawer below the panes: every number of the pinned texels, and the statistics of the rectangle.

use std::ops::Range;

use eframe::egui::{self, FontId, RichText, TextStyle};

use svbrdf_core::picture::quantity::Quantity;
use svbrdf_core::picture::statistics::Statistics;

use crate::jobs::displayed::Displayed;
use crate::jobs::panes::region::RegionNumbers;
use crate::model::command::{Command, InspectionCommand};
use crate::model::inspection::{self, HEADS, Inspection, Region};
use crate::model::material::loaded::LoadedMaterial;
use crate::model::view::state::ViewState;
use crate::ui::widgets::readout::{fixed, in_width};
use crate::ui::widgets::theme;

/// Width of a name, and between columns, in points.
const NAME: f32 = 110.0;
const SPACING: f32 = 8.0;
/// Between the edge of the drawer and its contents, in points.
const MARGIN: f32 = 8.0;
/// Size of the numbers, in points.
const NUMBERS: f32 = 11.0;
/// Characters of a number in the columns of [`HEADS`].
const WIDTHS: [usize; HEADS.len()] = [6, 6, 6, 6, 6, 7, 7, 6, 6, 6, 6, 6, 6, 6];
/// Which columns of [`HEADS`] have three numbers.
const COLOURS: [usize; 5] = [0, 1, 2, 4, 7];
/// The column from which on a second table has the columns where one is too wide: the terms of the rendering.
const TERMS: usize = 5;

/// What the drawer shows.
#[derive(Debug)]
pub struct Drawer<'a> {
    pub inspection: &'a Inspection,
    pub materials: &'a [LoadedMaterial],
    pub state: &'a ViewState,
    /// The numbers of the rectangle, and whether they are up to date.
    pub region: Option<(&'a [RegionNumbers], bool)>,
}

impl<'a> Drawer<'a> {
    /// The drawer for what is displayed.
    pub fn new(displayed: Displayed<'a>) -> Self {
        let (inspection, view) = (&displayed.model.inspection, &displayed.model.view);
        let materials = displayed.materials();
        let numbers = |region| displayed.jobs.panes.region.get(region, materials, view);
        Self { inspection, materials, state: view, region: inspection.region.and_then(numbers) }
    }

    /// The drawer over the lower edge of the panes, which stay where they are.
    pub fn over(&self, ctx: &egui::Context, panes: egui::Rect) -> Vec<Command> {
        let area = egui::Area::new(egui::Id::unique("drawer"))
            .order(egui::Order::Middle)
            .pivot(egui::Align2::LEFT_BOTTOM)
            .fixed_pos(panes.left_bottom());
        let frame = |ui: &egui::Ui| egui::Frame::side_top_panel(ui.style());
        let response = area.show(ctx, |ui| {
            frame(ui).show(ui, |ui| {
                ui.set_width((panes.width() - 2.0 * MARGIN).max(0.0));
                self.ui(ui)
            })
        });
        response.inner.inner
    }

    fn ui(&self, ui: &mut egui::Ui) -> Vec<Command> {
        let mut commands = Vec::new();
        let tables = tables(ui);
        let height = self.height(tables.len());
        egui::ScrollArea::both()
            .auto_shrink([false, true])
            .max_height(height)
            .min_scrolled_height(height)
            .show(ui, |ui| {
                if let Some(region) = self.inspection.region {
                    self.region(ui, region, &mut commands);
                }
                if !self.inspection.pins.is_empty() {
                    self.pins(ui, &tables, &mut commands);
                }
            });
        commands
    }

    /// Of the contents, as far as the window has room for it.
    fn height(&self, tables: usize) -> f32 {
        const MOST: f32 = 260.0;
        let rows = (self.materials.len() + 1) as f32;
        let pins = self.inspection.pins.len() as f32 * tables as f32 * (19.0 * rows + 5.0);
        let pins = if pins > 0.0 { 28.0 + pins } else { 0.0 };
        let region = if self.inspection.region.is_some() { 31.0 + 19.0 * rows } else { 0.0 };
        (pins + region + 14.0).min(MOST)
    }

    fn pins(&self, ui: &mut egui::Ui, tables: &[Range<usize>], commands: &mut Vec<Command>) {
        ui.horizontal(|ui| {
            ui.strong("Pinned texels").on_hover_text("Computed in f64 under the light and view of now");
            if ui.small_button("Copy as CSV").on_hover_text("Every number in full").clicked() {
                commands.push(InspectionCommand::CopyPins.into());
            }
            if ui.small_button("Remove all pins").clicked() {
                commands.push(InspectionCommand::ClearPins.into());
            }
        });
        for (number, pin) in self.inspection.pins.iter().enumerate() {
            let materials = self.materials.iter().map(LoadedMaterial::material);
            let rows = inspection::rows(materials, *pin, &self.state.scene, &self.state.convention());
            for columns in tables {
                let grid = egui::Grid::new(("pin", number, columns.start)).num_columns(columns.len() + 1);
                grid.min_col_width(0.0).spacing([SPACING, 2.0]).striped(true).show(ui, |ui| {
                    self.pin_heading(ui, number, columns, commands);
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
    fn pin_heading(
        &self,
        ui: &mut egui::Ui,
        index: usize,
        columns: &Range<usize>,
        commands: &mut Vec<Command>,
    ) {
        let pin = self.inspection.pins[index];
        ui.horizontal(|ui| {
            ui.set_min_width(NAME);
            if columns.start == 0 {
                let name = format!("{}: {},{}", index + 1, pin[0], pin[1]);
                let button = ui.small_button(RichText::new(&name).monospace());
                if button.on_hover_text("Remove this pin").clicked() {
                    commands.push(InspectionCommand::TogglePin(pin).into());
                }
            }
        });
        for (name, meaning) in &HEADS[columns.clone()] {
            ui.label(RichText::new(*name).small().weak()).on_hover_text(*meaning);
        }
        ui.end_row();
    }

    fn name(&self, ui: &mut egui::Ui, index: usize) {
        let (text, colour) = match index {
            0 => (format!("gt {}", self.materials[0].name()), theme::ground_truth(ui.visuals())),
            _ => (format!("{index}  {}", self.materials[index].name()), ui.visuals().text_color()),
        };
        ui.scope(|ui| {
            ui.set_max_width(NAME);
            ui.add(egui::Label::new(RichText::new(text).small().color(colour)).truncate());
        });
    }

    fn region(&self, ui: &mut egui::Ui, region: Region, commands: &mut Vec<Command>) {
        let [columns, rows] = region.size();
        let size = self.materials.first().map_or([usize::MAX; 2], |one| one.material().size());
        let [left, top] = region.first;
        // Over a seam it ends in the next copy of the material.
        let [right, bottom] = [0, 1].map(|axis| region.last[axis] % size[axis]);
        ui.horizontal(|ui| {
            ui.strong(format!("Rectangle {left},{top} to {right},{bottom}"));
            ui.label(format!("{columns} x {rows} texels, {}", self.state.display.quantity.name()));
            if ui.small_button("Remove rectangle").on_hover_text("Esc").clicked() {
                commands.push(InspectionCommand::SetRegion(None).into());
            }
        });
        let Some((numbers, current)) = self.region else {
            ui.weak("Computing...");
            return;
        };
        ui.scope(|ui| {
            if !current {
                ui.set_opacity(0.5);
            }
            egui::Grid::new("rectangle").spacing([14.0, 2.0]).striped(true).show(ui, |ui| {
                self.region_rows(ui, numbers);
            });
        });
    }

    fn region_rows(&self, ui: &mut egui::Ui, numbers: &[RegionNumbers]) {
        let letters: &[&str] = match self.state.display.quantity {
            Quantity::Normal => &["x", "y", "z"],
            Quantity::Roughness => &[""],
            _ => &["R", "G", "B"],
        };
        ui.label("");
        for letter in letters {
            for head in ["mean", "min", "median", "95%", "max"] {
                ui.label(RichText::new(format!("{letter} {head}").trim()).small().weak());
            }
        }
        ui.label(RichText::new("loss").small().weak())
            .on_hover_text("Rendering loss of the rectangle under this light and view");
        ui.end_row();
        for (index, numbers) in numbers.iter().enumerate().take(self.materials.len()) {
            self.name(ui, index);
            for channel in &numbers.channels[..letters.len()] {
                let Some(Statistics { mean, minimum, median, p95, maximum, .. }) = channel else {
                    for _ in 0..5 {
                        ui.label("-");
                    }
                    continue;
                };
                for value in [mean, minimum, median, p95, maximum] {
                    ui.label(RichText::new(fixed(*value)).monospace().size(11.5));
                }
            }
            ui.label(
                RichText::new(numbers.loss.map_or(String::new(), fixed)).monospace().size(11.5).strong(),
            );
            ui.end_row();
        }
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
