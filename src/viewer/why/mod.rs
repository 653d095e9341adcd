//! Tab *Why*: maps and scenes from which the losses of the predictions come.

pub mod diagnosis;
pub mod hypotheses;
pub mod maps;
pub mod replacement;
pub mod scenes;
pub mod thumbnails;

use eframe::egui::{self, Rect, RichText, Sense, Sides, vec2};

use serde_json::json;

use svbrdf_core::loss::{LossOptions, Request};
use svbrdf_core::model::convention::Convention;
use svbrdf_core::model::scene::Scene;
use svbrdf_evaluate::analyses::{ANALYSES, AnyAnalysis};
use svbrdf_evaluate::report::{AnalysisInput, Reader, Table, comparing};

use crate::error::Error;
use crate::jobs::Shown;
use crate::jobs::answers::content::{ComparedPair, Content, mask_of, read_all, refuse_mask};
use crate::jobs::answers::{Pace, Question, Work};
use crate::model::material::loaded::LoadedMaterial;
use crate::model::settings::WhySection;
use crate::model::view::ViewState;
use crate::model::{Model, display};
use crate::widgets::names::shortened;
use crate::widgets::paint::PanelTextures;
use crate::widgets::{answered, copy_table, report_table, theme};

/// Most predictions with high rows.
const LONG: usize = 4;
/// Characters of a name in a row.
const NAME: usize = 30;

/// Draws the tab.
pub fn ui(ui: &mut egui::Ui, shown: Shown<'_>, next: &mut Model, textures: &mut PanelTextures) {
    let (model, answers) = (shown.model, &shown.jobs.answers);
    let pairs = ComparedPair::all(&model.materials.all, &model.view);
    let Some(pair) = pairs.get(model.view.display.prediction) else {
        ui.label("Open a prediction to compare with the ground truth.");
        return;
    };
    ui.strong("Loss in this scene").on_hover_text(
        "Under the light and view of the panes: the mean of the log difference over the texels",
    );
    let losses = SceneLosses::of(&model.materials.all, &model.view);
    let losses = losses.and_then(|question| answers.drawn(&question));
    ui.scope(|ui| {
        if losses.as_ref().is_none_or(|(_, is_current)| !is_current) {
            ui.set_opacity(0.5);
        }
        rows(ui, shown, losses.as_ref().map(|(losses, _)| losses.as_slice()), next);
    });
    error_map(ui, &model.view, &mut next.view);
    let tables = ANALYSES.iter().filter(|analysis| !analysis.title.is_empty());
    let tables = tables.map(|one| (WhySection::Table(one.name), one.title, one.details));
    let own = [
        (
            WhySection::Diagnosis,
            "Would something trivial explain it?",
            "Whether an exposure, a shift, a symmetry or another reading of the files explains the loss",
        ),
        (WhySection::Maps, "Which map", "How much of the loss comes from each map"),
        (WhySection::Scenes, "Which scenes", "The scenes of the loss, worst first"),
    ];
    for (section, title, question) in own.into_iter().chain(tables) {
        ui.separator();
        let open = model.settings.sections.is_open(section);
        let header = egui::CollapsingHeader::new(RichText::new(title).strong()).open(Some(open));
        let header = header.show_unindented(ui, |ui| match section {
            WhySection::Diagnosis | WhySection::Hypotheses => diagnosis::ui(ui, shown, pair, next),
            WhySection::Maps => maps::ui(ui, shown, &pairs, next),
            WhySection::Scenes => scenes::ui(ui, shown, pair, textures, next),
            WhySection::Table(analysis) => {
                let (pair, scenes) = (pair.clone(), model.settings.loss.listed_scenes());
                answered(ui, answers.get(&Analyse { analysis, pair, scenes }), table);
            }
        });
        if header.header_response.on_hover_text(question).clicked() {
            next.settings.sections.toggle(section);
        }
    }
}

/// A row per prediction, which stays where it is while its loss is computed.
fn rows(ui: &mut egui::Ui, shown: Shown<'_>, losses: Option<&[f64]>, next: &mut Model) {
    let predictions = shown.model.materials.predictions();
    let names: Vec<&str> = predictions.iter().map(LoadedMaterial::name).collect();
    let most = losses.unwrap_or_default().iter().copied().fold(f64::MIN_POSITIVE, f64::max);
    // Many rows are low ones.
    let is_long = names.len() > LONG;
    ui.spacing_mut().item_spacing.y = if is_long { 1.0 } else { 4.0 };
    let height = if is_long { 2.0 } else { 6.0 };
    for (index, name) in shortened(&names, NAME).into_iter().enumerate() {
        let loss = losses.and_then(|losses| losses.get(index));
        let left = |ui: &mut egui::Ui| {
            ui.selectable_label(
                index == shown.model.view.display.prediction,
                format!("{}  {name}", predictions[index].slot),
            )
            .on_hover_text(names[index])
        };
        let right = |ui: &mut egui::Ui| {
            ui.label(
                RichText::new(loss.map_or_else(|| "\u{2013}".to_owned(), |loss| format!("{loss:.4}")))
                    .monospace(),
            );
        };
        let (response, ()) = Sides::new().shrink_left().truncate().show(ui, left, right);
        if response.clicked() {
            display::choose(next, index);
        }
        let (area, _) = ui.allocate_exact_size(vec2(ui.available_width(), height), Sense::hover());
        let bar = Rect::from_min_size(
            area.min,
            vec2(area.width() * (loss.unwrap_or(&0.0) / most) as f32, area.height()),
        );
        ui.painter().rect_filled(bar, 1.0, theme::series(predictions[index].slot, ui.visuals().dark_mode));
    }
}

/// The button that shows where the loss comes from.
fn error_map(ui: &mut egui::Ui, view: &ViewState, next: &mut ViewState) {
    ui.add_space(6.0);
    let is_displayed = view.display.difference && view.is_error_map();
    let hover = "Where on the material the loss comes from: the log difference of each texel, averaged over the scenes of \
                 the loss";
    let button = ui.add(egui::Button::new("Error map").selected(is_displayed));
    if button.on_hover_text(hover).clicked() && !is_displayed {
        next.show_error_map();
    }
}

/// The table of the chosen prediction.
fn table(ui: &mut egui::Ui, AnalysisTable { heading, table }: &AnalysisTable) {
    ui.horizontal(|ui| {
        copy_table(ui, || format!("{heading}\n{}", table.text()));
        let line = RichText::new(heading.trim_end().replace('\n', "; ")).small().weak();
        ui.add(egui::Label::new(line).truncate()).on_hover_text(heading.trim_end());
    });
    report_table(ui, table);
}

/// The loss of each prediction under a light and view. The ground truth is the first of the materials.
#[derive(Clone, Debug, PartialEq)]
pub struct SceneLosses {
    pub materials: Vec<Content>,
    pub scene: Scene,
    pub convention: Convention,
}

impl SceneLosses {
    /// What is drawn under this view, where there is a prediction.
    pub fn of(materials: &[LoadedMaterial], view: &ViewState) -> Option<Self> {
        let (scene, convention) = (view.scene, view.convention());
        (materials.len() > 1).then(|| Self { materials: Content::all(materials), scene, convention })
    }
}

impl Question for SceneLosses {
    type Answer = Vec<f64>;
    const PACE: Pace = Pace::AtOnce;
    const KEPT: usize = 1;

    fn is_like(&self, earlier: &Self) -> bool {
        self.materials == earlier.materials
    }

    fn answer(&self, work: &Work<'_, Self::Answer>) -> Result<Vec<f64>, Error> {
        let read = read_all(&self.materials)?;
        let all: Vec<_> = read.iter().map(|one| one.material()).collect();
        comparing(all[0], &all[1..], self.convention, mask_of(&read)?, |comparison| {
            let outcome = comparison.run(&Request::Listed(vec![self.scene]), work.progress())?;
            Ok(outcome.losses.iter().map(|loss| loss.estimate.mean).collect())
        })
    }
}

/// The report of an analysis of a pair.
#[derive(Clone, Debug, PartialEq)]
pub struct Analyse {
    /// The name of the analysis.
    pub analysis: &'static str,
    pub pair: ComparedPair,
    pub scenes: Request,
}

/// The report of an analysis of one prediction.
#[derive(Clone, Debug)]
pub struct AnalysisTable {
    /// The lines about its settings.
    pub heading: String,
    pub table: Table,
}

impl Question for Analyse {
    type Answer = AnalysisTable;

    fn answer(&self, work: &Work<'_, Self::Answer>) -> Result<AnalysisTable, Error> {
        let analysis = AnyAnalysis::named(self.analysis)
            .ok_or_else(|| Error::internal(format!("there is no analysis {}", self.analysis)))?;
        let [truth, prediction] = &self.pair.read()?;
        if !analysis.paired {
            refuse_mask(
                std::slice::from_ref(truth),
                "This is over all texels, and not over those of a mask",
            )?;
        }
        let seed = LossOptions { seed: self.scenes.seed(), ..LossOptions::default() };
        let request = match analysis.lists_scenes() {
            true => self.scenes.clone(),
            false => analysis.request(&seed, None)?,
        };
        let input = AnalysisInput {
            ground_truth: truth.material(),
            predictions: vec![prediction.material()],
            storages: vec![&truth.storage, &prediction.storage],
            paths: Vec::new(),
            convention: self.pair.convention,
            request,
            few_scenes: false,
            mask: truth.record.mask.clone(),
        };
        let report = analysis.run(&input, json!({}), work.progress())?;
        Ok(AnalysisTable { heading: report.heading(), table: report.table(Reader::Person) })
    }
}
