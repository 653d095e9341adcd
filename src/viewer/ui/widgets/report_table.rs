//! Table of a report.

use eframe::egui::{self, RichText};

use svbrdf_evaluate::report::{Cell, Table};

use crate::model::material::loaded::drawable;

/// The table of a report, which scrolls sideways.
pub fn grid(ui: &mut egui::Ui, table: &Table) {
    egui::ScrollArea::horizontal().id_salt("table").show(ui, |ui| {
        egui::Grid::new("table").striped(true).spacing([8.0, 2.0]).min_row_height(0.0).show(ui, |ui| {
            for title in &table.columns {
                ui.label(RichText::new(drawable(title)).small().strong());
            }
            ui.end_row();
            for row in &table.rows {
                row.iter().for_each(|cell| value(ui, cell));
                ui.end_row();
            }
        });
    });
}

/// Words to the left, numbers to the right.
fn value(ui: &mut egui::Ui, cell: &Cell) {
    let text = RichText::new(drawable(&cell.text())).small();
    match cell {
        Cell::Text(_) => ui.label(text),
        _ => {
            ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| ui.label(text.monospace()))
                .inner
        }
    };
}
