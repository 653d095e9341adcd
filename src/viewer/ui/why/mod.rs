//! Tab *Why*: maps and scenes from which the losses of the predictions come.

pub mod diagnosis;
pub mod hypotheses;
pub mod maps;
pub mod row;
pub mod scenes;
pub mod tables;

use eframe::egui::{self, Rect, RichText, Sense, Sides, vec2};

use svbrdf_core::loss::LossSettings;
use svbrdf_core::picture::quantity::Quantity;

use crate::jobs::why::{ComparedPair, WhyJobs};
use crate::model::command::{Command, DisplayCommand, WhyCommand};
use crate::model::material::loaded::LoadedMaterial;
use crate::model::settings::why::{WhySection, WhySections, WhyState};
use crate::model::view::state::ViewState;
use crate::ui::widgets::names::shortened;
use crate::ui::widgets::texture::PanelTextures;
use crate::ui::widgets::theme;

use diagnosis::DiagnosisSection;
use maps::MapsSection;

/// Most predictions with high rows.
const LONG: usize = 4;
/// Characters of a name in a row.
const NAME: usize = 30;

/// What the tab shows.
#[derive(Debug)]
pub struct WhyPanel<'a> {
    pub state: &'a ViewState,
    /// The loss of each prediction in the current scene, and whether they are up to date.
    pub losses: Option<(&'a [f64], bool)>,
    /// Of the predictions.
    pub names: Vec<&'a str>,
    pub predictions: &'a [LoadedMaterial],
    /// The ground truth and each prediction.
    pub pairs: Vec<ComparedPair>,
    pub why: WhyState,
    pub jobs: &'a WhyJobs,
    pub sections: &'a WhySections,
    /// Say which scenes are listed.
    pub settings: &'a LossSettings,
}

impl WhyPanel<'_> {
    pub fn ui(&self, ui: &mut egui::Ui, textures: &mut PanelTextures) -> Vec<Command> {
        let mut commands = Vec::new();
        let Some(pair) = self.pairs.get(self.state.display.prediction) else {
            ui.label("Open a prediction to compare with the ground truth.");
            return commands;
        };
        ui.strong("Loss in this scene").on_hover_text(
            "Under the light and view of the panes: the mean of the log difference over the texels",
        );
        ui.scope(|ui| {
            if self.losses.is_none_or(|(_, current)| !current) {
                ui.set_opacity(0.5);
            }
            self.rows(ui, self.losses.map(|(losses, _)| losses), &mut commands);
        });
        self.displayed_quantity(ui, &mut commands);
        let tables = self.jobs.tables.analyses();
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
            let open = self.sections.is_open(section);
            let header = egui::CollapsingHeader::new(RichText::new(title).strong()).open(Some(open));
            let header = header.show_unindented(ui, |ui| match section {
                WhySection::Diagnosis | WhySection::Hypotheses => {
                    let Self { state, jobs, settings, pairs, predictions, .. } = self;
                    let shows_all = self.sections.is_open(WhySection::Hypotheses);
                    DiagnosisSection { state, jobs, settings, pairs, predictions, shows_all }
                        .ui(ui, &mut commands);
                }
                WhySection::Maps => {
                    let Self { state, jobs, settings, pairs, names, .. } = self;
                    MapsSection { state, jobs, settings, pairs, names }.ui(ui, &mut commands);
                }
                WhySection::Scenes => self.scenes(ui, pair, textures, &mut commands),
                WhySection::Table(analysis) => {
                    tables::ui(ui, self.jobs.tables.get(analysis, pair, &self.settings.listed_scenes()))
                }
            });
            if header.header_response.on_hover_text(question).clicked() {
                commands.push(WhyCommand::ShowSection(section, !open).into());
            }
        }
        commands
    }

    /// A row per prediction, which stays where it is while its loss is computed.
    fn rows(&self, ui: &mut egui::Ui, losses: Option<&[f64]>, commands: &mut Vec<Command>) {
        let most = losses.unwrap_or_default().iter().copied().fold(f64::MIN_POSITIVE, f64::max);
        // Many rows are low ones.
        let is_long = self.names.len() > LONG;
        ui.spacing_mut().item_spacing.y = if is_long { 1.0 } else { 4.0 };
        let height = if is_long { 2.0 } else { 6.0 };
        for (index, name) in shortened(&self.names, NAME).into_iter().enumerate() {
            let loss = losses.and_then(|losses| losses.get(index));
            let left = |ui: &mut egui::Ui| {
                ui.selectable_label(index == self.state.display.prediction, format!("{}  {name}", index + 1))
                    .on_hover_text(self.names[index])
            };
            let right = |ui: &mut egui::Ui| {
                ui.label(
                    RichText::new(loss.map_or_else(|| "\u{2013}".to_owned(), |loss| format!("{loss:.4}")))
                        .monospace(),
                );
            };
            let (response, ()) = Sides::new().shrink_left().truncate().show(ui, left, right);
            if response.clicked() {
                commands.push(DisplayCommand::ChoosePrediction(index).into());
            }
            let (area, _) = ui.allocate_exact_size(vec2(ui.available_width(), height), Sense::hover());
            let bar = Rect::from_min_size(
                area.min,
                vec2(area.width() * (loss.unwrap_or(&0.0) / most) as f32, area.height()),
            );
            ui.painter().rect_filled(bar, 1.0, theme::series(index, ui.visuals().dark_mode));
        }
    }

    /// What the panes show: values, or differences.
    fn displayed_quantity(&self, ui: &mut egui::Ui, commands: &mut Vec<Command>) {
        ui.add_space(6.0);
        let difference = self.state.display.difference;
        ui.horizontal_wrapped(|ui| {
            let label = if difference { "Show the values" } else { "Show where: the difference" };
            if ui.button(label).on_hover_text("Value or difference in the panes (D)").clicked() {
                commands.push(DisplayCommand::ShowDifference(!difference).into());
            }
            let is_displayed = difference && self.state.is_error_map();
            let hover = "Where on the material the loss comes from: the log difference of each texel, averaged over the \
                         scenes of the loss";
            let button = ui.add(egui::Button::new("Error map").selected(is_displayed));
            if button.on_hover_text(hover).clicked() && !is_displayed {
                let rendering = DisplayCommand::SetQuantity(Quantity::Rendering);
                let on = DisplayCommand::ShowDifference(true);
                commands.extend([rendering, DisplayCommand::ChooseErrorMap, on].map(Command::from));
            }
        });
    }
}
