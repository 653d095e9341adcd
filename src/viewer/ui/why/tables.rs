//! The table of an analysis that has no section of its own.

use std::time::Duration;

use eframe::egui::{self, RichText};

use svbrdf_evaluate::report::{Cell, Table};

use crate::jobs::why::AnalysisTable;

/// The table of the chosen prediction, or how far it is.
pub fn ui(ui: &mut egui::Ui, found: Result<&AnalysisTable, Option<(f32, Duration)>>) {
    let AnalysisTable { heading, table } = match found {
        Ok(found) => found,
        Err(busy) => {
            let (fraction, elapsed) = busy.unwrap_or_default();
            let bar = egui::ProgressBar::new(fraction).text(format!("{} s", elapsed.as_secs()));
            ui.add(bar.corner_radius(3.0));
            return;
        }
    };
    ui.horizontal(|ui| {
        if ui.small_button("Copy").on_hover_text("The table as text, with its settings").clicked() {
            ui.copy_text(format!("{heading}\n{}", table.text()));
        }
        ui.add(
            egui::Label::new(RichText::new(heading.trim_end().replace('\n', "; ")).small().weak()).truncate(),
        )
        .on_hover_text(heading.trim_end());
    });
    grid(ui, table);
}

/// The table of a report, which scrolls sideways.
pub fn grid(ui: &mut egui::Ui, table: &Table) {
    egui::ScrollArea::horizontal().id_salt("table").show(ui, |ui| {
        egui::Grid::new("table").striped(true).spacing([8.0, 2.0]).min_row_height(0.0).show(ui, |ui| {
            for title in &table.columns {
                ui.label(RichText::new(title).small().strong());
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
    let text = RichText::new(cell.text()).small();
    match cell {
        Cell::Text(_) => ui.label(text),
        _ => {
            ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| ui.label(text.monospace()))
                .inner
        }
    };
}
