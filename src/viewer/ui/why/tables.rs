//! The table of an analysis that has no section of its own.

use std::time::Duration;

use eframe::egui::{self, RichText};

use crate::jobs::why::AnalysisTable;
use crate::ui::widgets::report_table;

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
    report_table::grid(ui, table);
}
