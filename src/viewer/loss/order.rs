//! Fold on the robustness of the order of predictions, or of methods, below them.

use eframe::egui::{self, RichText};

use svbrdf_evaluate::report::{Reader, Report as _};
use svbrdf_evaluate::robust::RobustReport;

use crate::jobs::answers::Answer;
use crate::jobs::order::OrderAnswer;
use crate::model::material::loaded::drawable;
use crate::widgets::{progress, report_table, theme};

/// The fold, which is unfolded where it `asks`, with the answer to `ask`.
pub fn fold(ui: &mut egui::Ui, asks: &mut bool, ask: impl FnOnce() -> Answer<OrderAnswer>) {
    ui.add_space(4.0);
    let title = RichText::new("Does the order survive?").strong();
    let header = egui::CollapsingHeader::new(title).open(Some(*asks));
    let header = header.show_unindented(ui, |ui| match ask() {
        Answer::Partial(_, fraction, elapsed) | Answer::Running(fraction, elapsed) => {
            progress(ui, fraction, format!("{} s", elapsed.as_secs()));
        }
        Answer::Ready(found) => match &found.answer {
            Ok(report) => answer(ui, report),
            Err(problem) => {
                ui.label(RichText::new(drawable(problem)).small().color(theme::problem(ui.visuals())));
            }
        },
        Answer::Stopped(_) | Answer::Failed(_) => {}
    });
    let hover = "The order under other conventions, epsilons and scenes, as `svbrdf rank --robust` prints it";
    *asks ^= header.header_response.on_hover_text(hover).clicked();
}

/// The sentence, the pairs that change sides, and the order under every question.
fn answer(ui: &mut egui::Ui, report: &RobustReport) {
    ui.label(drawable(&report.sentence));
    for change in report.changes() {
        ui.label(RichText::new(drawable(&change)).small().weak());
    }
    if ui.small_button("Copy").on_hover_text("The table as text, with its settings").clicked() {
        ui.copy_text(report.text());
    }
    report_table(ui, &report.table(Reader::Person));
}
