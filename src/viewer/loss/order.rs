//! Whether the order of predictions, or of methods, survives: the fold below them, and the question of predictions.

use eframe::egui::{self, RichText};

use svbrdf_core::loss::{Comparison, Request};
use svbrdf_core::model::convention::Convention;
use svbrdf_evaluate::report::{Reader, Report as _};
use svbrdf_evaluate::robust::RobustReport;

use crate::error::Error;
use crate::jobs::answers::content::Content;
use crate::jobs::answers::{Answer, Question, Work};
use crate::model::Model;
use crate::model::material::loaded::{LoadedMaterial, drawable};
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

/// Whether the order of the predictions survives. The ground truth is the first of the materials, each with its name.
#[derive(Clone, Debug, PartialEq)]
pub struct PredictionOrder {
    materials: Vec<(Content, String)>,
    convention: Convention,
    /// The losses.
    request: Request,
}

impl PredictionOrder {
    /// Of the materials in the window, the ground truth first.
    pub fn of(model: &Model) -> Self {
        let named = |one: &LoadedMaterial| (Content::of(one), one.name().to_owned());
        let (convention, loss) = (model.view.convention(), &model.settings.loss);
        let request = Request::Accuracy { target: loss.target_percent / 100.0, seed: loss.seed };
        Self { materials: model.materials.all.iter().map(named).collect(), convention, request }
    }
}

impl Question for PredictionOrder {
    type Answer = RobustReport;
    const HAS_MESSAGE: bool = false;

    fn answer(&self, work: &Work<'_, Self::Answer>) -> Result<RobustReport, Error> {
        let named =
            |(one, name): &(Content, String)| Ok(one.read()?.material().clone().renamed(name.clone()));
        let materials = self.materials.iter().map(named).collect::<Result<Vec<_>, Error>>()?;
        let [ground_truth, predictions @ ..] = materials.as_slice() else {
            return Err(Error::internal("there is no ground truth"));
        };
        let predictions: Vec<_> = predictions.iter().collect();
        let comparison = Comparison::new(ground_truth, &predictions, self.convention)?;
        Ok(RobustReport::new(&comparison, &self.request, work.progress())?)
    }
}
