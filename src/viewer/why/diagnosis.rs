//! Section of the diagnosis: whether an error of exposure, alignment or reading explains the loss of each prediction.

use eframe::egui::text::TextFormat;
use eframe::egui::{self, Align2, FontId, RichText, pos2, vec2};

use svbrdf_evaluate::diagnose::{Diagnosis, Finding, SCENES, sentence};

use crate::files::read_options::{is_offered, remedy_button};
use crate::jobs::displayed::Displayed;
use crate::jobs::why::{ComparedPair, Diagnosed, WhyJobs};
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
    let seed = model.settings.loss.seed;
    let section = DiagnosisSection { state: &model.view, jobs: &shown.jobs.why, seed, pairs, predictions };
    let diagnosed = section.diagnosed(pair);
    ui.scope(|ui| {
        ui.spacing_mut().item_spacing.y = 1.0;
        if pairs.len() > 1 {
            section.predictions(ui, next);
        }
        ui.add_space(4.0);
        section.sentence(ui, pair, diagnosed);
        section.remedy(ui, prediction, diagnosed, next);
        let corrected = model.view.display.corrected;
        let is_open = model.settings.sections.is_open(WhySection::Hypotheses);
        HypothesisLines { pair, diagnosed, corrected, is_open }.ui(ui, next);
    });
    section.state_line(ui, pair, diagnosed);
}

/// What the section depends on.
#[derive(Debug)]
struct DiagnosisSection<'a> {
    state: &'a ViewState,
    jobs: &'a WhyJobs,
    seed: u64,
    pairs: &'a [ComparedPair],
    predictions: &'a [LoadedMaterial],
}

impl DiagnosisSection<'_> {
    fn diagnosed(&self, pair: &ComparedPair) -> Option<&Diagnosed> {
        self.jobs.diagnosis.get(pair, self.seed)
    }

    /// A row per prediction with its first mark.
    fn predictions(&self, ui: &mut egui::Ui, next: &mut Model) {
        let names: Vec<&str> = self.predictions.iter().map(LoadedMaterial::name).collect();
        for (index, (pair, name)) in self.pairs.iter().zip(shortened(&names, CHARACTERS)).enumerate() {
            let diagnosed = self.diagnosed(pair);
            let first = diagnosed.and_then(|diagnosed| diagnosed.diagnosis.marked().next());
            let text = match (diagnosed, first) {
                (None, _) => "...".to_owned(),
                (Some(_), None) => "nothing trivial".to_owned(),
                (_, Some(finding)) => format!("{} {}", label(finding.hypothesis), share(finding)),
            };
            let change = first.and_then(|finding| shown_change(finding, pair));
            let is_chosen = index == self.state.display.prediction;
            let row = Row { label: format!("Diagnosis of {}: {text}", names[index]), selected: is_chosen };
            let (response, area) = row.ui(ui, true);
            let ink = ui.visuals().text_color();
            let (font, painter) = (FontId::proportional(12.5), ui.painter());
            let left = pos2(area.left() + 4.0, area.center().y);
            painter.text(left, Align2::LEFT_CENTER, format!("{}  {name}", index + 1), font.clone(), ink);
            let colour = match first {
                // The others have too little contrast on the colour of the selection.
                _ if is_chosen => ink,
                Some(_) => theme::accent(ui.visuals()),
                None => ui.visuals().weak_text_color(),
            };
            painter.text(area.right_center() - vec2(SHARE, 0.0), Align2::RIGHT_CENTER, text, font, colour);
            let response = response.on_hover_text(match (diagnosed, change) {
                (None, _) => "It is being diagnosed".to_owned(),
                (Some(diagnosed), None) => self.words(pair, &diagnosed.diagnosis),
                (Some(diagnosed), Some(_)) => {
                    format!("{}\nClick to show it corrected", self.words(pair, &diagnosed.diagnosis))
                }
            });
            if response.clicked() {
                next.view.choose(index);
                let corrected = self.state.display.corrected.filter(|_| is_chosen);
                toggle(&mut next.view, change, corrected);
            }
        }
    }

    fn words(&self, pair: &ComparedPair, diagnosis: &Diagnosis) -> String {
        sentence(diagnosis, self.jobs.diagnosis.floor(pair, self.seed))
    }

    /// The finding in words, in rows of constant height.
    fn sentence(&self, ui: &mut egui::Ui, pair: &ComparedPair, diagnosed: Option<&Diagnosed>) {
        let text = diagnosed.map(|diagnosed| self.words(pair, &diagnosed.diagnosis));
        let format = TextFormat::simple(FontId::proportional(13.0), ui.visuals().text_color());
        let hover = text.clone().unwrap_or_default();
        rows(ui, text, format, SENTENCE, &hover);
    }

    /// The button that corrects the reading, in a row of constant height.
    fn remedy(
        &self,
        ui: &mut egui::Ui,
        prediction: &LoadedMaterial,
        diagnosed: Option<&Diagnosed>,
        next: &mut Model,
    ) {
        let height = ui.spacing().interact_size.y;
        ui.allocate_ui(vec2(ui.available_width(), height), |ui| {
            ui.set_min_height(height);
            let marked = diagnosed.into_iter().flat_map(|diagnosed| diagnosed.diagnosis.marked());
            let mut remedies = marked.filter_map(Finding::remedy_of_prediction);
            let remedy = remedies.find(|one| is_offered(prediction, *one));
            if let Some(remedy) = remedy {
                let index = self.state.display.prediction + 1;
                remedy_button(ui, index, prediction, remedy, next);
            }
        });
    }

    /// One line of constant height: the progress, or the floor and what it took.
    fn state_line(&self, ui: &mut egui::Ui, pair: &ComparedPair, diagnosed: Option<&Diagnosed>) {
        let height = ui.spacing().interact_size.y;
        let Some(Diagnosed { elapsed, .. }) = diagnosed else {
            let (fraction, elapsed) = self.jobs.diagnosis.busy().unwrap_or_default();
            let text = format!("Trying changes, {} s", elapsed.as_secs());
            progress(ui, fraction, text);
            return;
        };
        let floor = self.jobs.diagnosis.floor(pair, self.seed).map(|floor| digits(floor.mean));
        let floor =
            floor.map(|floor| format!("Losses below {floor} are not resolvable; ")).unwrap_or_default();
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
}
