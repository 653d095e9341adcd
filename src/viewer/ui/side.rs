//! Side panel: a tab, and below it the photograph, light and view.

use eframe::egui::{self, RichText};

use svbrdf_evaluate::diagnose::Finding;
use svbrdf_files::read::Certainty;

use super::dataset::summary;
use super::loss::panel::LossPanel;
use super::materials::panel::MaterialsPanel;
use super::panels::light_and_view::ScenePanel;
use super::photograph::PhotographCard;
use super::why::WhyPanel;
use super::widgets::texture::PanelTextures;
use super::widgets::{bare, order};
use crate::jobs::displayed::Displayed;
use crate::jobs::why::ComparedPair;
use crate::model::command::{Command, WindowCommand};
use crate::model::material::loaded::LoadedMaterial;
use crate::model::settings::Tab;

pub fn ui(ui: &mut egui::Ui, displayed: Displayed<'_>, textures: &mut PanelTextures) -> Vec<Command> {
    let (model, jobs) = (displayed.model, displayed.jobs);
    let mut commands = tabs(ui, displayed);
    bare(egui::Panel::bottom("scene"), ui).resizable(false).show(ui, |ui| {
        let header = egui::CollapsingHeader::new("Light and view").default_open(true);
        let scene = ScenePanel {
            state: &model.view,
            conventions: &model.conventions,
            highlight_follows: model.settings.highlight_follows,
        };
        let header = header.show_unindented(ui, |ui| commands.extend(scene.ui(ui)));
        header
            .header_response
            .on_hover_text("The scene of the panes, and the convention of renderings and loss");
    });
    if let Some(photograph) = jobs.photograph.displayed(&model.photograph, displayed.materials()) {
        let is_compared = displayed.photograph().is_some();
        let names = displayed.materials().iter().map(LoadedMaterial::name).collect();
        let card = PhotographCard { photograph, listed: model.photograph.listed(), names, is_compared };
        bare(egui::Panel::bottom("photograph"), ui)
            .resizable(false)
            .show(ui, |ui| commands.extend(card.ui(ui)));
    }
    let tab = model.tab();
    let scroll = egui::ScrollArea::vertical().id_salt(tab as usize);
    scroll.auto_shrink([false, false]).show(ui, |ui| {
        commands.extend(match tab {
            Tab::Loss => loss_tab(ui, displayed),
            Tab::Methods => summary::ui(ui, displayed),
            Tab::Why => why_tab(ui, displayed, textures),
            Tab::Files => {
                let (materials, openings) = (&model.materials, &jobs.openings);
                let findings = findings(displayed);
                MaterialsPanel { materials, openings, watch: model.settings.watch, findings }.ui(ui)
            }
        });
    });
    commands
}

/// The marked findings of each prediction that was diagnosed.
fn findings(displayed: Displayed<'_>) -> Vec<Vec<&Finding>> {
    let (model, jobs) = (displayed.model, displayed.jobs);
    let of = |pair: &ComparedPair| {
        let diagnosed = jobs.why.diagnosis.get(pair, model.settings.loss.seed);
        diagnosed.into_iter().flat_map(|diagnosed| diagnosed.diagnosis.marked()).collect()
    };
    ComparedPair::all(&model.materials.all, &model.view).iter().map(of).collect()
}

fn tabs(ui: &mut egui::Ui, displayed: Displayed<'_>) -> Vec<Command> {
    let model = displayed.model;
    let mut commands = Vec::new();
    let unsure = unsure_guesses(displayed);
    ui.horizontal(|ui| {
        let has_methods = model.has_methods();
        for (tab, name, question) in
            Tab::ALL.into_iter().filter(|(tab, ..)| has_methods || *tab != Tab::Methods)
        {
            let text = match tab {
                Tab::Files if unsure > 0 => {
                    RichText::new(format!("{name} ({unsure}?)")).color(ui.visuals().warn_fg_color)
                }
                _ => RichText::new(name),
            };
            let label = ui.selectable_label(model.tab() == tab, text.size(14.5));
            label.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Tab, true, format!("Tab {name}")));
            let hover = match tab {
                Tab::Files if unsure > 0 => format!("{question} {unsure} guesses are unsure"),
                _ => question.to_owned(),
            };
            if label.on_hover_text(hover).clicked() {
                commands.push(WindowCommand::ChooseTab(tab).into());
            }
        }
    });
    ui.separator();
    commands
}

fn loss_tab(ui: &mut egui::Ui, displayed: Displayed<'_>) -> Vec<Command> {
    let (model, jobs) = (displayed.model, displayed.jobs);
    let loss = LossPanel {
        settings: &model.settings.loss,
        auto: model.settings.auto_loss,
        job: &jobs.loss,
        materials: &model.materials,
        chosen: model.view.display.prediction,
    };
    let mut commands = loss.ui(ui);
    if model.materials.predictions().len() > 1 {
        commands.extend(order::fold(ui, model.asks_order, &jobs.order));
    }
    commands.extend(unsure_reading(ui, displayed));
    commands
}

/// Below the losses: that some may be of files that were read wrongly. A click opens *Files*.
fn unsure_reading(ui: &mut egui::Ui, displayed: Displayed<'_>) -> Option<Command> {
    let unsure = unsure_guesses(displayed);
    let text = match unsure {
        0 => return None,
        1 => "A guess in reading is unsure".to_owned(),
        _ => format!("{unsure} guesses in reading are unsure"),
    };
    let label = ui.link(RichText::new(text).small().color(ui.visuals().warn_fg_color));
    let hover = "The losses depend on how files were read: see Files";
    label.on_hover_text(hover).clicked().then(|| WindowCommand::ChooseTab(Tab::Files).into())
}

fn unsure_guesses(displayed: Displayed<'_>) -> usize {
    let all = displayed.model.materials.all.iter().flat_map(|one| &one.read.record.assumptions);
    all.filter(|assumption| assumption.certainty == Certainty::Unsure).count()
}

fn why_tab(ui: &mut egui::Ui, displayed: Displayed<'_>, textures: &mut PanelTextures) -> Vec<Command> {
    let (model, jobs) = (displayed.model, displayed.jobs);
    let why = WhyPanel {
        state: &model.view,
        losses: jobs.scene_loss.get(&model.materials.all, &model.view),
        names: model.materials.predictions().iter().map(LoadedMaterial::name).collect(),
        predictions: model.materials.predictions(),
        pairs: ComparedPair::all(&model.materials.all, &model.view),
        why: model.why,
        jobs: &jobs.why,
        sections: &model.settings.sections,
        settings: &model.settings.loss,
    };
    why.ui(ui, textures)
}
