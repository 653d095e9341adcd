//! Section of the diagnosis: whether an error of exposure, alignment or reading explains the loss of the chosen prediction.

use eframe::egui::text::TextFormat;
use eframe::egui::{self, FontId, vec2};

use svbrdf_core::loss::Estimate;
use svbrdf_evaluate::diagnose::{Diagnosis, Finding, SCENES, sentence};

use crate::files::read_options::{is_offered, remedy_button};
use crate::jobs::answers::Answered;
use crate::jobs::answers::content::ComparedPair;
use crate::jobs::displayed::Displayed;
use crate::jobs::why::questions::diagnosis;
use crate::model::Model;
use crate::model::material::loaded::LoadedMaterial;
use crate::model::settings::WhySection;
use crate::why::hypotheses::HypothesisLines;
use crate::widgets::numbers::{digits, seconds};
use crate::widgets::{rows, state_line};

/// Rows of the sentence.
const SENTENCE: usize = 3;

/// The section of the chosen prediction, whose pair this is.
pub fn ui(ui: &mut egui::Ui, shown: Displayed<'_>, pair: &ComparedPair, next: &mut Model) {
    let model = shown.model;
    let (Some(ground_truth), Some(prediction)) = (model.materials.ground_truth(), model.chosen_prediction())
    else {
        return;
    };
    let (floor, found) = diagnosis(&shown.jobs.answers, pair, model.settings.loss.seed);
    let (floor, busy, found) = (floor.as_deref().map(|floor| &floor.answer), found.busy(), found.ready());
    let diagnosed = found.as_deref();
    ui.scope(|ui| {
        ui.spacing_mut().item_spacing.y = 1.0;
        ui.add_space(4.0);
        show_sentence(ui, floor, diagnosed);
        show_remedy(ui, model, prediction, diagnosed, next);
        let corrected = model.view.display.corrected;
        let is_open = model.settings.sections.is_open(WhySection::Hypotheses);
        let diagnosed = diagnosed.map(|found| &found.answer);
        HypothesisLines { ground_truth, prediction, diagnosed, corrected, is_open }.ui(ui, next);
    });
    let (fraction, elapsed) = busy.unwrap_or_default();
    let doing = || format!("Trying changes, {} s", elapsed.as_secs());
    state_line(ui, found.as_deref().map(|found| summary(floor, found)), ABOUT, (fraction, doing));
}

/// The button that corrects the reading, in a row of constant height.
fn show_remedy(
    ui: &mut egui::Ui,
    model: &Model,
    prediction: &LoadedMaterial,
    diagnosed: Option<&Answered<Diagnosis>>,
    next: &mut Model,
) {
    let height = ui.spacing().interact_size.y;
    ui.allocate_ui(vec2(ui.available_width(), height), |ui| {
        ui.set_min_height(height);
        let marked = diagnosed.into_iter().flat_map(|diagnosed| diagnosed.marked());
        let mut remedies = marked.filter_map(Finding::remedy_of_prediction);
        if let Some(remedy) = remedies.find(|one| is_offered(prediction, *one)) {
            remedy_button(ui, model.view.display.prediction + 1, prediction, remedy, next);
        }
    });
}

/// The finding in words, in rows of constant height.
fn show_sentence(ui: &mut egui::Ui, floor: Option<&Estimate>, diagnosed: Option<&Answered<Diagnosis>>) {
    let text = diagnosed.map(|diagnosed| sentence(diagnosed, floor));
    let format = TextFormat::simple(FontId::proportional(13.0), ui.visuals().text_color());
    let hover = text.clone().unwrap_or_default();
    rows(ui, text, format, SENTENCE, &hover);
}

/// What the state line tells of more than it has room for.
const ABOUT: &str = "The part of the loss that each change removes, in scenes other than those that its value was fitted in. A dot \
                     marks changes that lower the loss significantly and by at least 10%. The floor is the loss that the steps of \
                     the maps of the ground truth leave: smaller losses are not resolvable. Folding this section cancels the work.";

/// The floor, and what the diagnosis took.
fn summary(floor: Option<&Estimate>, diagnosed: &Answered<Diagnosis>) -> String {
    let below = |floor: &Estimate| format!("Losses below {} are not resolvable; ", digits(floor.mean));
    let [near, distant] = SCENES;
    let floor = floor.map(below).unwrap_or_default();
    format!("{floor}{near} + {distant} scenes, {}", seconds(diagnosed.elapsed))
}
