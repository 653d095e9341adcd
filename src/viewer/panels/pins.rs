//! The drawer below the panes: every number of the pinned texels, and the statistics of the rectangle.

use eframe::egui::{self, RichText};

use crate::picture::quantity::Quantity;
use crate::picture::statistics::Statistics;
use crate::viewer::command::{Command, InspectCommand};
use crate::viewer::inspect::{self, HEADS, Inspect, Region, RegionNumbers};
use crate::viewer::readout::fixed;
use crate::viewer::slot::Slot;
use crate::viewer::state::ViewState;
use crate::viewer::theme;

/// Width of a name, in points.
const NAME: f32 = 130.0;

/// What the drawer shows.
#[derive(Debug)]
pub(crate) struct Drawer<'a> {
    pub inspect: &'a Inspect,
    pub slots: &'a [Slot],
    pub state: &'a ViewState,
    /// The numbers of the rectangle, and whether they are up to date.
    pub region: Option<(&'a [RegionNumbers], bool)>,
}

impl Drawer<'_> {
    pub(crate) fn ui(&self, ui: &mut egui::Ui) -> Vec<Command> {
        let mut commands = Vec::new();
        let height = self.height();
        egui::ScrollArea::both()
            .auto_shrink([false, true])
            .max_height(height)
            .min_scrolled_height(height)
            .show(ui, |ui| {
                if let Some(region) = self.inspect.region {
                    self.region(ui, region, &mut commands);
                }
                if !self.inspect.pins.is_empty() {
                    self.pins(ui, &mut commands);
                }
            });
        commands
    }

    /// Of the contents, as far as the window has room for it.
    fn height(&self) -> f32 {
        const MOST: f32 = 260.0;
        let pins = self.inspect.pins.len() * self.slots.len();
        let pins = if pins > 0 { 50.0 + 21.0 * pins as f32 } else { 0.0 };
        let region = if self.inspect.region.is_some() { 50.0 + 19.0 * self.slots.len() as f32 } else { 0.0 };
        (pins + region + 14.0).min(MOST)
    }

    fn pins(&self, ui: &mut egui::Ui, commands: &mut Vec<Command>) {
        ui.horizontal(|ui| {
            ui.strong("Pinned texels").on_hover_text("Computed in f64 under the light and view of now");
            if ui.small_button("Copy as CSV").on_hover_text("Every number in full").clicked() {
                commands.push(InspectCommand::CopyPins.into());
            }
            if ui.small_button("Remove all pins").clicked() {
                commands.push(InspectCommand::ClearPins.into());
            }
        });
        egui::Grid::new("pins").num_columns(HEADS.len() + 2).spacing([14.0, 2.0]).striped(true).show(
            ui,
            |ui| {
                ui.label("");
                ui.label("");
                for (name, meaning) in HEADS {
                    ui.label(RichText::new(name).small().weak()).on_hover_text(meaning);
                }
                ui.end_row();
                for (index, pin) in self.inspect.pins.iter().enumerate() {
                    self.pin(ui, index, *pin, commands);
                }
            },
        );
    }

    /// A line for each material.
    fn pin(&self, ui: &mut egui::Ui, index: usize, pin: [usize; 2], commands: &mut Vec<Command>) {
        let materials = self.slots.iter().map(|slot| &slot.loaded.material);
        let rows = inspect::rows(materials, pin, &self.state.scene, &self.state.convention());
        for (slot, row) in rows.iter().enumerate() {
            if slot == 0 {
                let name = format!("{}: {},{}", index + 1, pin[0], pin[1]);
                let button = ui.small_button(RichText::new(&name).monospace());
                if button.on_hover_text("Remove this pin").clicked() {
                    commands.push(InspectCommand::TogglePin(pin).into());
                }
            } else {
                ui.label("");
            }
            self.name(ui, slot);
            for cell in row.cells() {
                let text: Vec<String> = cell.into_iter().map(fixed).collect();
                ui.label(RichText::new(text.join(" ")).monospace().size(11.5));
            }
            ui.end_row();
        }
    }

    fn name(&self, ui: &mut egui::Ui, slot: usize) {
        let (text, colour) = match slot {
            0 => (format!("gt {}", self.slots[0].name()), theme::accent(ui.visuals())),
            _ => (format!("{slot}  {}", self.slots[slot].name()), ui.visuals().text_color()),
        };
        ui.scope(|ui| {
            ui.set_max_width(NAME);
            ui.add(egui::Label::new(RichText::new(text).small().color(colour)).truncate());
        });
    }

    fn region(&self, ui: &mut egui::Ui, region: Region, commands: &mut Vec<Command>) {
        let [columns, rows] = region.size();
        let ([left, top], [right, bottom]) = (region.first, region.last);
        ui.horizontal(|ui| {
            ui.strong(format!("Rectangle {left},{top} to {right},{bottom}"));
            ui.label(format!("{columns} x {rows} texels, {}", self.state.quantity.name()));
            if ui.small_button("Remove rectangle").on_hover_text("Esc").clicked() {
                commands.push(InspectCommand::SetRegion(None).into());
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
        let letters: &[&str] = match self.state.quantity {
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
        for (slot, numbers) in numbers.iter().enumerate().take(self.slots.len()) {
            self.name(ui, slot);
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
