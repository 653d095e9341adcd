//! Content of the window: the panes, and the legend or the histograms below them. It is what a saved picture of the view shows.

use eframe::egui;

use super::bare;
use super::legend::histograms::ValueStrip;
use super::legend::strip::LegendStrip;
use super::pane::scenery::Scenery;
use super::pane::viewport::{PaneDrawing, Viewport};
use super::shading::gpu_view::GpuView;
use super::widgets::texture::PanelTextures;
use crate::viewer::jobs::displayed::Displayed;
use crate::viewer::model::command::Command;

/// The panes and what is below them.
#[derive(Debug)]
pub struct Content<'a> {
    pub displayed: Displayed<'a>,
    pub viewport: &'a mut Viewport,
    pub textures: &'a mut PanelTextures,
    /// Share of the window between its bars that the drawer takes.
    pub drawer_share: f32,
}

impl Content<'_> {
    pub fn ui(&mut self, ui: &mut egui::Ui, gpu: Option<&mut GpuView>) -> Vec<Command> {
        let (displayed, model) = (self.displayed, self.displayed.model);
        let mut commands = Vec::new();
        // A saved picture has the arrangement of the window, also at another size.
        let undivided = ui.available_height() / (1.0 - self.drawer_share).max(0.1);
        let has_ground_truth = model.materials.ground_truth().is_some();
        if model.view.display.difference && compares(displayed) {
            bare(egui::Panel::bottom("legend"), ui)
                .show(ui, |ui| commands.extend(LegendStrip::new(displayed).ui(ui)));
        }
        if model.settings.histograms && !model.view.display.difference && has_ground_truth {
            bare(egui::Panel::bottom("values"), ui).show(ui, |ui| ValueStrip::new(displayed).ui(ui));
        }
        egui::CentralPanel::no_frame().show(ui, |ui| {
            let scenery = scenery(ui.ctx(), displayed, undivided);
            let drawing = PaneDrawing { gpu, uploads: &displayed.jobs.uploads, textures: self.textures };
            commands.extend(self.viewport.ui(ui, &scenery, drawing));
        });
        commands
    }
}

/// Whether there is something to compare: predictions, or a photograph.
fn compares(displayed: Displayed<'_>) -> bool {
    !displayed.model.materials.predictions().is_empty() || displayed.photograph().is_some()
}

/// What the panes display; `undivided` is the height of the panes with the drawer and the legend closed, in points.
pub fn scenery<'a>(ctx: &egui::Context, displayed: Displayed<'a>, undivided: f32) -> Scenery<'a> {
    let model = displayed.model;
    Scenery {
        materials: displayed.materials(),
        state: &model.view,
        dark: model.settings.dark,
        highlight_follows: model.settings.highlight_follows,
        view_handle: model.settings.view_handle,
        peek: ctx.input(|i| i.key_down(egui::Key::G)) && !ctx.text_edit_focused(),
        swapped: model.swapped,
        reading: !displayed.jobs.openings.is_empty(),
        range: displayed.range(),
        error_maps: displayed.error_maps().map(AsRef::as_ref),
        photograph: displayed.photograph(),
        inspection: &model.inspection,
        undivided,
    }
}
