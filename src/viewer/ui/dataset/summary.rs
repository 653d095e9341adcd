//! Summary of a data set: what `svbrdf rank --dataset` prints.

use eframe::egui::{self, RichText};

use svbrdf_evaluate::report::{Reader, Report as _};

use crate::jobs::displayed::Displayed;
use crate::model::Model;
use crate::model::material::loaded::drawable;
use crate::ui::widgets::{order, report_table};

pub fn ui(ui: &mut egui::Ui, displayed: Displayed<'_>, next: &mut Model) {
    let Some(open) = displayed.model.dataset.open.as_deref() else { return };
    let jobs = &displayed.jobs.dataset;
    let Some(report) = jobs.summary.get() else {
        ui.weak("No loss is known yet.");
        return;
    };
    let (known, all) = (jobs.losses.count(), open.cases.len());
    if known < all {
        let bar = egui::ProgressBar::new(known as f32 / all as f32);
        ui.add(bar.text(format!("losses of {known} of {all} materials")));
    }
    ui.horizontal(|ui| {
        if ui.small_button("Copy").on_hover_text("The table as text, with its settings").clicked() {
            ui.copy_text(report.text());
        }
        if ui.small_button("LaTeX").on_hover_text("Copies the table for a paper").clicked() {
            ui.copy_text(report.latex());
        }
    });
    report_table::grid(ui, &report.table(Reader::Person));
    for condition in report.conditions() {
        ui.label(RichText::new(drawable(&condition)).small().weak());
    }
    if open.methods().len() > 1 {
        order::fold(ui, &mut next.asks_order, &jobs.order);
    }
}
