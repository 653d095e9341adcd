//! Summary: what `svbrdf rank --dataset` prints, of the losses that are known.

use std::sync::Arc;

use eframe::egui::{self, RichText};

use svbrdf_evaluate::dataset::{self, DatasetReport, DatasetSettings};
use svbrdf_evaluate::report::{Reader, Report as _};
use svbrdf_evaluate::robust::RobustReport;

use crate::dataset::losses::{self, DatasetLosses, PICK};
use crate::error::Error;
use crate::jobs::Shown;
use crate::jobs::answers::{Answered, Pace, Question, Work};
use crate::jobs::work::threads;
use crate::loss::losses::fold;
use crate::model::Model;
use crate::model::dataset::OpenDataset;
use crate::model::material::loaded::drawable;
use crate::widgets::{copy_table, report_table};

/// The table of the methods over the materials whose losses are known.
#[derive(Clone, Debug)]
struct Summarize {
    open: Arc<OpenDataset>,
    settings: DatasetSettings,
    losses: Arc<Answered<DatasetLosses>>,
}

impl PartialEq for Summarize {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.losses, &other.losses)
    }
}

impl Question for Summarize {
    type Answer = DatasetReport;
    const PACE: Pace = Pace::AtOnce;
    const KEPT: usize = 1;

    fn is_like(&self, earlier: &Self) -> bool {
        Arc::ptr_eq(&self.open, &earlier.open)
    }

    fn answer(&self, _: &Work<'_, Self::Answer>) -> Result<DatasetReport, Error> {
        let results = self.losses.results().cloned().collect();
        Ok(DatasetReport::new(self.settings.clone(), self.open.reading.clone(), results, PICK))
    }
}

/// The latest summary of the data set that is open, as soon as there is one.
pub fn drawn(shown: Shown<'_>) -> Option<Arc<Answered<DatasetReport>>> {
    let (open, losses) = (shown.model.dataset.open.clone()?, losses::ask(shown));
    let settings = losses::settings(&open, &shown.model.view.convention);
    let is_known = losses.results().next().is_some();
    let question = is_known.then_some(Summarize { open, settings, losses })?;
    shown.jobs.answers.drawn(&question).map(|(report, _)| report)
}

/// Whether the order of the methods survives, as `svbrdf rank --dataset --robust` asks.
#[derive(Clone, Debug)]
struct MethodOrder {
    open: Arc<OpenDataset>,
    /// In the convention of the window.
    settings: DatasetSettings,
    /// How often each material was read again.
    versions: Arc<Vec<u64>>,
}

impl PartialEq for MethodOrder {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.open, &other.open)
            && self.settings.convention == other.settings.convention
            && self.versions == other.versions
    }
}

impl Question for MethodOrder {
    type Answer = RobustReport;
    const HAS_MESSAGE: bool = false;

    fn answer(&self, work: &Work<'_, Self::Answer>) -> Result<RobustReport, Error> {
        // Threads of its own, as for the losses.
        let pool = threads::background_pool().map_err(|error| Error::internal(error.to_string()))?;
        let (cases, reading, progress) = (&self.open.cases, &self.open.reading, work.progress());
        pool.install(|| Ok(dataset::robust(cases, &self.settings, reading, |_| (), progress)?))
    }
}

/// Draws the section.
pub fn ui(ui: &mut egui::Ui, shown: Shown<'_>, next: &mut Model) {
    let Some(open) = &shown.model.dataset.open else { return };
    let answers = &shown.jobs.answers;
    let settings = losses::settings(open, &shown.model.view.convention);
    if open.is_of_predictions() {
        let accuracy = open.settings.scenes.description(open.settings.seed);
        ui.label(RichText::new(accuracy).small().weak());
        return;
    }
    let Some(report) = drawn(shown) else {
        ui.weak("No loss is known yet.");
        return;
    };
    ui.horizontal(|ui| {
        copy_table(ui, || report.text());
        if ui.small_button("LaTeX").on_hover_text("Copies the table for a paper").clicked() {
            ui.copy_text(report.latex());
        }
    });
    report_table(ui, &report.table(Reader::Person));
    for condition in report.conditions() {
        ui.label(RichText::new(drawable(&condition)).small().weak());
    }
    if open.methods().len() > 1 {
        let (open, versions) = (open.clone(), shown.model.dataset.versions.clone());
        fold(ui, &mut next.asks_order, || answers.get(&MethodOrder { open, settings, versions }));
    }
}
