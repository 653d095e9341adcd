//! Side panel: a tab, and below it the photograph, light and view.

use eframe::egui::{self, RichText};

use svbrdf_files::read::Certainty;

use crate::frame::light_and_view;
use crate::jobs::Shown;
use crate::loss::losses::PredictionOrder;
use crate::model::Model;
use crate::model::settings::Tab;
use crate::pane::Displayed;
use crate::widgets::bare;
use crate::widgets::paint::PanelTextures;
use crate::{dataset, files, loss, photograph, why};

pub fn ui(ui: &mut egui::Ui, displayed: &Displayed<'_>, next: &mut Model, textures: &mut PanelTextures) {
    let shown @ Shown { model, jobs } = displayed.shown();
    tabs(ui, model, &mut next.settings.tab);
    bare(egui::Panel::bottom("scene"), ui).resizable(false).show(ui, |ui| {
        let header = egui::CollapsingHeader::new("Light and view").default_open(true);
        let header = header.show_unindented(ui, |ui| light_and_view::ui(ui, model, next));
        header
            .header_response
            .on_hover_text("The scene of the panes, and the convention of renderings and loss");
    });
    if let Some(open) = &displayed.open_photograph {
        let is_compared = displayed.photograph().is_some();
        let panel = bare(egui::Panel::bottom("photograph"), ui).resizable(false);
        panel.show(ui, |ui| photograph::ui(ui, open, displayed.materials(), is_compared, next));
    }
    let tab = model.settings.tab;
    let scroll = egui::ScrollArea::vertical().id_salt(tab as usize);
    scroll.auto_shrink([false, false]).show(ui, |ui| match tab {
        Tab::Loss if model.dataset.open.is_some() => {
            dataset::summary::ui(ui, shown, next);
            unsure_reading(ui, model, &mut next.settings.tab);
        }
        Tab::Loss => {
            loss::ui(ui, shown, next);
            if model.materials.predictions().len() > 1 {
                let ask = || jobs.answers.get(&PredictionOrder::of(model));
                loss::losses::fold(ui, &mut next.asks_order, ask);
            }
            unsure_reading(ui, model, &mut next.settings.tab);
        }
        Tab::Why => why::ui(ui, shown, next, textures),
        Tab::Files => files::ui(ui, shown, next),
    });
}

fn tabs(ui: &mut egui::Ui, model: &Model, next: &mut Tab) {
    let unsure = unsure_guesses(model);
    ui.horizontal(|ui| {
        let has_methods = model.has_methods();
        for (tab, name, question) in Tab::ALL {
            let (name, question) = match tab {
                Tab::Loss if has_methods => ("Methods", "Which method is better over the data set?"),
                _ => (name, question),
            };
            let text = match tab {
                Tab::Files if unsure > 0 => {
                    RichText::new(format!("{name} ({unsure}?)")).color(ui.visuals().warn_fg_color)
                }
                _ => RichText::new(name),
            };
            let label = ui.selectable_label(model.settings.tab == tab, text.size(14.5));
            label.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Tab, true, format!("Tab {name}")));
            let hover = match tab {
                Tab::Files if unsure > 0 => format!("{question} {unsure} guesses are unsure"),
                _ => question.to_owned(),
            };
            if label.on_hover_text(hover).clicked() {
                *next = tab;
            }
        }
    });
    ui.separator();
}

/// Below the losses: that some may be of files that were read wrongly. A click opens *Files*.
fn unsure_reading(ui: &mut egui::Ui, model: &Model, next: &mut Tab) {
    let text = match unsure_guesses(model) {
        0 => return,
        1 => "A guess in reading is unsure".to_owned(),
        unsure => format!("{unsure} guesses in reading are unsure"),
    };
    let label = ui.link(RichText::new(text).small().color(ui.visuals().warn_fg_color));
    if label.on_hover_text("The losses depend on how files were read: see Files").clicked() {
        *next = Tab::Files;
    }
}

fn unsure_guesses(model: &Model) -> usize {
    let all = model.materials.all.iter().flat_map(|one| &one.read.record.assumptions);
    all.filter(|assumption| assumption.certainty == Certainty::Unsure).count()
}
