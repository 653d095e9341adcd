//! Fold on the robustness of the order of predictions, or of methods, below them.

use eframe::egui::{self, RichText};

use svbrdf_evaluate::report::{Reader, Report as _};
use svbrdf_evaluate::robust::RobustReport;

use crate::jobs::answers::Answer;
use crate::model::material::loaded::drawable;
use crate::widgets::{answered, copy_table, report_table};

/// The fold, which is unfolded where it `asks`, with the answer to `ask`.
pub fn fold(ui: &mut egui::Ui, asks: &mut bool, ask: impl FnOnce() -> Answer<RobustReport>) {
    ui.add_space(4.0);
    let title = RichText::new("Does the order survive?").strong();
    let header = egui::CollapsingHeader::new(title).open(Some(*asks));
    let header = header.show_unindented(ui, |ui| answered(ui, ask(), answer));
    let hover = "The order under other conventions, epsilons and scenes, as `svbrdf rank --robust` prints it";
    *asks ^= header.header_response.on_hover_text(hover).clicked();
}

/// The sentence, the pairs that change sides, and the order under every question.
fn answer(ui: &mut egui::Ui, report: &RobustReport) {
    ui.label(drawable(&report.sentence));
    for change in report.changes() {
        ui.label(RichText::new(drawable(&change)).small().weak());
    }
    copy_table(ui, || report.text());
    report_table(ui, &report.table(Reader::Person));
}
