//! Section of the diagnosis: whether an error of exposure, alignment or reading explains the loss of the chosen prediction.

use std::sync::Arc;

use eframe::egui::text::TextFormat;
use eframe::egui::{self, FontId};

use svbrdf_core::loss::Estimate;
use svbrdf_core::model::convention::Convention;
use svbrdf_evaluate::diagnose::{Diagnosis, Explained, Finding, SCENES, floor, sentence};
use svbrdf_files::read::ReadOptions;
use svbrdf_files::source::Place;

use crate::error::Error;
use crate::jobs::Shown;
use crate::jobs::answers::content::{ComparedPair, Content, refuse_mask};
use crate::jobs::answers::{Answer, Answered, Answers, Question, Work};
use crate::model::material::loaded::LoadedMaterial;
use crate::model::settings::WhySection;
use crate::model::{Model, opening};
use crate::why::hypotheses::HypothesisLines;
use crate::widgets::numbers::{digits, seconds};
use crate::widgets::{of_height, rows, state_line};

/// Rows of the sentence.
const SENTENCE: usize = 3;

/// The section of the chosen prediction, whose pair this is.
pub fn ui(ui: &mut egui::Ui, shown: Shown<'_>, pair: &ComparedPair, next: &mut Model) {
    let model = shown.model;
    let (Some(ground_truth), Some(prediction)) = (model.materials.ground_truth(), model.chosen_prediction())
    else {
        return;
    };
    let (floor, found) = diagnosis(&shown.jobs.answers, pair, model.settings.loss.seed);
    let (floor, busy) = (floor.as_deref().map(|floor| &floor.answer), found.busy());
    let (found, is_whole) = match found {
        Answer::Partial(found, ..) => (Some(found), false),
        found => (found.ready(), true),
    };
    let diagnosed = found.as_deref();
    ui.scope(|ui| {
        ui.spacing_mut().item_spacing.y = 1.0;
        ui.add_space(4.0);
        show_sentence(ui, floor, diagnosed);
        show_remedy(ui, model, prediction, diagnosed, next);
        let corrected = model.view.display.corrected;
        let is_open = model.settings.sections.is_open(WhySection::Hypotheses);
        let found = diagnosed.map_or(&[][..], |found| &found.findings);
        HypothesisLines { ground_truth, prediction, found, corrected, is_open }.ui(ui, next);
    });
    let (fraction, elapsed) = busy.unwrap_or_default();
    let doing = || format!("Trying changes, {} s", elapsed.as_secs());
    let whole = found.as_deref().filter(|_| is_whole);
    state_line(ui, whole.map(|found| summary(floor, found)), ABOUT, (fraction, doing));
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
    of_height(ui, height, |ui| {
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
    let [near, distant] = SCENES;
    let floor = floor.map(|floor| format!("Floor {}; ", digits(floor.mean))).unwrap_or_default();
    format!("{floor}{near} + {distant} scenes, {}", seconds(diagnosed.elapsed))
}

/// Whether a material can be read again with the options: one of a file that does not have them yet.
pub fn is_offered(material: &LoadedMaterial, remedy: ReadOptions) -> bool {
    let read = &material.read;
    matches!(read.source.place, Place::Path(_)) && remedy.over(read.record.options) != read.record.options
}

/// The button for the material at `index`; a click reads it again, and shows it as it is read.
pub fn remedy_button(
    ui: &mut egui::Ui,
    index: usize,
    material: &LoadedMaterial,
    remedy: ReadOptions,
    next: &mut Model,
) {
    let words = remedy.words().replace("specular-albedo", "specular").replace(['-', '='], " ");
    let button = ui.small_button(format!("Read with {}", words.replace(',', ", ")));
    let hover = format!(
        "Read {} again with this option, as Change... in Files does; undo (Ctrl+Z) goes back. If the ground truth is the one that is \
         read wrongly, change it instead",
        material.name()
    );
    if button.on_hover_text(hover).clicked() {
        next.view.correct(None);
        opening::read_as(next, index, remedy.over(material.read.record.options));
    }
}

/// The loss that a ground truth cannot resolve.
#[derive(Clone, Debug, PartialEq)]
pub struct Floor {
    pub ground_truth: Content,
    pub convention: Convention,
    pub seed: u64,
}

impl Floor {
    fn of(pair: &ComparedPair, seed: u64) -> Self {
        Self { ground_truth: pair.ground_truth.clone(), convention: pair.convention, seed }
    }
}

impl Question for Floor {
    type Answer = Estimate;

    fn answer(&self, work: &Work<'_, Self::Answer>) -> Result<Estimate, Error> {
        let read = self.ground_truth.read()?;
        refuse_mask(std::slice::from_ref(&read), "A diagnosis is of all texels, and not of those of a mask")?;
        Ok(floor(read.material(), &read.storage, &self.convention, self.seed, work.progress())?)
    }
}

/// Whether something trivial explains the loss of a pair.
#[derive(Clone, Debug, PartialEq)]
pub struct Diagnose {
    pub pair: ComparedPair,
    /// The loss that its ground truth cannot resolve.
    pub floor: f64,
    pub seed: u64,
}

impl Diagnose {
    fn of(pair: &ComparedPair, seed: u64, floor: Option<&Answered<Estimate>>) -> Self {
        Self { pair: pair.clone(), floor: floor.map_or(0.0, |floor| floor.mean), seed }
    }
}

impl Question for Diagnose {
    type Answer = Diagnosis;

    fn answer(&self, work: &Work<'_, Self::Answer>) -> Result<Diagnosis, Error> {
        let [truth, prediction] = &self.pair.read()?;
        refuse_mask(std::slice::from_ref(truth), "A diagnosis is of all texels, and not of those of a mask")?;
        let materials = [truth.material(), prediction.material()];
        let storages = [&truth.storage, &prediction.storage];
        let (convention, progress) = (&self.pair.convention, work.progress());
        let explained = Explained::of(materials, storages, convention, self.floor, self.seed, progress)?;
        work.tell(explained.marked());
        Ok(explained.with_all_lines()?)
    }
}

/// The floor and the diagnosis of a pair.
fn diagnosis(
    answers: &Answers,
    pair: &ComparedPair,
    seed: u64,
) -> (Option<Arc<Answered<Estimate>>>, Answer<Diagnosis>) {
    let floor = match answers.get(&Floor::of(pair, seed)) {
        Answer::Running(fraction, elapsed) => return (None, Answer::Running(fraction, elapsed)),
        floor => floor.ready(),
    };
    let found = answers.get(&Diagnose::of(pair, seed, floor.as_deref()));
    (floor, found)
}

/// The diagnosis of a pair, where it is known.
pub fn known_diagnosis(
    answers: &Answers,
    pair: &ComparedPair,
    seed: u64,
) -> Option<Arc<Answered<Diagnosis>>> {
    let floor = answers.known(&Floor::of(pair, seed));
    answers.known(&Diagnose::of(pair, seed, floor.as_deref()))
}
