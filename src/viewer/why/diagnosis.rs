//! Section of the diagnosis: whether an error of exposure, alignment or reading explains the loss of each prediction.

use std::time::Duration;

use eframe::egui::text::TextFormat;
use eframe::egui::{self, Align2, FontId, RichText, pos2, vec2};

use svbrdf_core::loss::Estimate;
use svbrdf_evaluate::diagnose::{Diagnosis, Finding, SCENES, sentence};

use crate::files::read_options::{is_offered, remedy_button};
use crate::jobs::answers::content::ComparedPair;
use crate::jobs::answers::{Answered, Answers};
use crate::jobs::displayed::Displayed;
use crate::jobs::why::questions::diagnosis;
use crate::model::Model;
use crate::model::material::loaded::LoadedMaterial;
use crate::model::settings::WhySection;
use crate::model::view::ViewState;
use crate::why::hypotheses::{HypothesisLines, Row, SHARE, label, share, shown_change, toggle};
use crate::widgets::names::shortened;
use crate::widgets::numbers::{digits, seconds};
use crate::widgets::{progress, rows, theme};

/// Rows of the sentence.
const SENTENCE: usize = 3;
/// Characters of the name of a prediction.
const CHARACTERS: usize = 20;

/// The section; `pairs` are the ground truth and each prediction.
pub fn ui(ui: &mut egui::Ui, shown: Displayed<'_>, pairs: &[ComparedPair], next: &mut Model) {
    let (model, chosen) = (shown.model, shown.model.view.display.prediction);
    let predictions = model.materials.predictions();
    let (Some(pair), Some(prediction)) = (pairs.get(chosen), predictions.get(chosen)) else { return };
    let ground_truth = &model.materials.all[0];
    let seed = model.settings.loss.seed;
    let answers = &shown.jobs.answers;
    let (floor, found) = diagnosis(answers, pair, seed, false);
    let (floor, busy, found) = (floor.as_deref().map(|floor| &floor.answer), found.busy(), found.ready());
    let diagnosed = found.as_deref();
    let section = DiagnosisSection { state: &model.view, answers, seed, floor, pairs, predictions };
    ui.scope(|ui| {
        ui.spacing_mut().item_spacing.y = 1.0;
        if pairs.len() > 1 {
            section.predictions(ui, next);
        }
        ui.add_space(4.0);
        show_sentence(ui, floor, diagnosed);
        section.remedy(ui, prediction, diagnosed, next);
        let corrected = model.view.display.corrected;
        let is_open = model.settings.sections.is_open(WhySection::Hypotheses);
        let diagnosed = diagnosed.map(|found| &found.answer);
        HypothesisLines { ground_truth, prediction, diagnosed, corrected, is_open }.ui(ui, next);
    });
    state_line(ui, floor, diagnosed, busy.unwrap_or_default());
}

/// What the section depends on.
#[derive(Debug)]
struct DiagnosisSection<'a> {
    state: &'a ViewState,
    answers: &'a Answers,
    seed: u64,
    floor: Option<&'a Estimate>,
    pairs: &'a [ComparedPair],
    predictions: &'a [LoadedMaterial],
}

impl DiagnosisSection<'_> {
    /// A row per prediction with its first mark.
    fn predictions(&self, ui: &mut egui::Ui, next: &mut Model) {
        let names: Vec<&str> = self.predictions.iter().map(LoadedMaterial::name).collect();
        for (index, (pair, name)) in self.pairs.iter().zip(shortened(&names, CHARACTERS)).enumerate() {
            let found = diagnosis(self.answers, pair, self.seed, true).1.ready();
            let diagnosed = found.as_deref();
            let first = diagnosed.and_then(|diagnosed| diagnosed.marked().next());
            let text = match (diagnosed, first) {
                (None, _) => "...".to_owned(),
                (Some(_), None) => "nothing trivial".to_owned(),
                (_, Some(finding)) => format!("{} {}", label(finding.hypothesis), share(finding)),
            };
            let change = first.and_then(|finding| shown_change(finding, &self.predictions[index]));
            let is_chosen = index == self.state.display.prediction;
            let row = Row { label: format!("Diagnosis of {}: {text}", names[index]), selected: is_chosen };
            let (response, area) = row.ui(ui, true);
            let ink = ui.visuals().text_color();
            let (font, painter) = (FontId::proportional(12.5), ui.painter());
            let left = pos2(area.left() + 4.0, area.center().y);
            let name = format!("{}  {name}", self.predictions[index].slot);
            painter.text(left, Align2::LEFT_CENTER, name, font.clone(), ink);
            let colour = match first {
                // The others have too little contrast on the colour of the selection.
                _ if is_chosen => ink,
                Some(_) => theme::accent(ui.visuals()),
                None => ui.visuals().weak_text_color(),
            };
            painter.text(area.right_center() - vec2(SHARE, 0.0), Align2::RIGHT_CENTER, text, font, colour);
            let response = response.on_hover_text(match (diagnosed, change) {
                (None, _) => "It is being diagnosed".to_owned(),
                (Some(diagnosed), None) => sentence(diagnosed, self.floor),
                (Some(diagnosed), Some(_)) => {
                    format!("{}\nClick to show it corrected", sentence(diagnosed, self.floor))
                }
            });
            if response.clicked() {
                next.view.choose(index);
                let corrected = self.state.display.corrected.filter(|_| is_chosen);
                toggle(&mut next.view, change, corrected);
            }
        }
    }

    /// The button that corrects the reading, in a row of constant height.
    fn remedy(
        &self,
        ui: &mut egui::Ui,
        prediction: &LoadedMaterial,
        diagnosed: Option<&Answered<Diagnosis>>,
        next: &mut Model,
    ) {
        let height = ui.spacing().interact_size.y;
        ui.allocate_ui(vec2(ui.available_width(), height), |ui| {
            ui.set_min_height(height);
            let marked = diagnosed.into_iter().flat_map(|diagnosed| diagnosed.marked());
            let mut remedies = marked.filter_map(Finding::remedy_of_prediction);
            let remedy = remedies.find(|one| is_offered(prediction, *one));
            if let Some(remedy) = remedy {
                let index = self.state.display.prediction + 1;
                remedy_button(ui, index, prediction, remedy, next);
            }
        });
    }
}

/// The finding in words, in rows of constant height.
fn show_sentence(ui: &mut egui::Ui, floor: Option<&Estimate>, diagnosed: Option<&Answered<Diagnosis>>) {
    let text = diagnosed.map(|diagnosed| sentence(diagnosed, floor));
    let format = TextFormat::simple(FontId::proportional(13.0), ui.visuals().text_color());
    let hover = text.clone().unwrap_or_default();
    rows(ui, text, format, SENTENCE, &hover);
}

/// One line of constant height: the progress, or the floor and what it took.
fn state_line(
    ui: &mut egui::Ui,
    floor: Option<&Estimate>,
    diagnosed: Option<&Answered<Diagnosis>>,
    (fraction, elapsed): (f32, Duration),
) {
    let height = ui.spacing().interact_size.y;
    let Some(Answered { elapsed, .. }) = diagnosed else {
        progress(ui, fraction, format!("Trying changes, {} s", elapsed.as_secs()));
        return;
    };
    let below = |floor: &Estimate| format!("Losses below {} are not resolvable; ", digits(floor.mean));
    let floor = floor.map(below).unwrap_or_default();
    let [near, distant] = SCENES;
    let text = format!("{floor}{near} + {distant} scenes, {}", seconds(*elapsed));
    ui.allocate_ui(vec2(ui.available_width(), height), |ui| {
        ui.set_min_height(height);
        ui.add(egui::Label::new(RichText::new(text).small().weak()).truncate()).on_hover_text(
            "The part of the loss that each change removes, in scenes other than those that its value was fitted in. A dot marks \
             changes that lower the loss significantly and by at least 10%. The floor is the loss that the steps of the maps of \
             the ground truth leave: smaller losses are not resolvable. Folding this section cancels the work.",
        );
    });
}
