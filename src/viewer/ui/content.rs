//! Content of the window: the panes, and the legend below them. It is what a saved picture of the view shows.

use eframe::egui;

use svbrdf_core::model::scene::Kind;

use super::legend::strip::LegendStrip;
use super::pane::scenery::Scenery;
use super::pane::viewport::{STRIP, Viewport};
use super::shading::gpu_view::GpuView;
use super::widgets::bare;
use super::widgets::numbers::digits;
use crate::jobs::displayed::Displayed;
use crate::model::Model;
use crate::model::command::Command;

/// Height of the caption of a picture that is saved, in points.
pub const CAPTION: f32 = 20.0;

/// The panes and what is below them.
#[derive(Debug)]
pub struct CentralArea<'a> {
    pub displayed: Displayed<'a>,
    pub viewport: &'a mut Viewport,
}

impl CentralArea<'_> {
    pub fn ui(&mut self, ui: &mut egui::Ui, gpu: Option<&mut GpuView>) -> Vec<Command> {
        let displayed = self.displayed;
        let mut commands = Vec::new();
        if displayed.is_picture {
            let panel = bare(egui::Panel::bottom("caption"), ui).exact_size(CAPTION).resizable(false);
            panel.show(ui, |ui| caption(ui, displayed.model, self.magnification()));
        }
        let has_legend = displayed.model.view.display.difference && compares(displayed);
        if has_legend {
            let panel = bare(egui::Panel::bottom("strip"), ui).exact_size(STRIP).resizable(false);
            panel.show(ui, |ui| commands.extend(LegendStrip::new(displayed).ui(ui)));
        }
        egui::CentralPanel::no_frame().show(ui, |ui| {
            let scenery = scenery(ui.ctx(), displayed);
            commands.extend(self.viewport.ui(ui, &scenery, gpu, &displayed.jobs.uploads, has_legend));
        });
        commands
    }

    /// Screen pixels per texel, where there is a material.
    fn magnification(&self) -> Option<f32> {
        let grid = self.displayed.model.materials.ground_truth()?.grid();
        Some(self.viewport.magnification(grid, &self.displayed.model.view))
    }
}

/// How a saved picture was rendered, in a line that is cut where the picture is too narrow.
fn caption(ui: &mut egui::Ui, model: &Model, magnification: Option<f32>) {
    let view = &model.view;
    let place = |[x, y, z]: [f64; 3]| format!("{x:.2}, {y:.2}, {z:.2}");
    let kind = if view.scene.kind == Kind::Near { "near-field" } else { "distant" };
    let size = model.materials.ground_truth().map(|one| one.material().size());
    let texels = size.map(|[width, height]| format!("{width} x {height} texels"));
    let parts = [
        texels,
        magnification.map(|pixels| format!("{} pixels per texel", digits(f64::from(pixels)))),
        Some(format!("{kind} light {}", place(view.scene.light))),
        Some(format!("view {}", place(view.scene.view))),
        Some(format!("exposure {:+.1} EV", view.exposure_ev)),
        Some(view.convention().name.to_owned()),
    ];
    let text = parts.into_iter().flatten().collect::<Vec<_>>().join("  \u{b7}  ");
    ui.horizontal_centered(|ui| {
        ui.add_space(8.0);
        ui.add(egui::Label::new(egui::RichText::new(text).small()).truncate());
    });
}

/// Whether there is something to compare: predictions, or a photograph.
fn compares(displayed: Displayed<'_>) -> bool {
    !displayed.model.materials.predictions().is_empty() || displayed.photograph().is_some()
}

/// What the panes display.
pub fn scenery<'a>(ctx: &egui::Context, displayed: Displayed<'a>) -> Scenery<'a> {
    let model = displayed.model;
    Scenery {
        materials: displayed.materials(),
        state: &model.view,
        dark: model.settings.dark,
        highlight_follows: model.settings.highlight_follows,
        is_picture: displayed.is_picture,
        peek: ctx.input(|i| i.key_down(egui::Key::G)) && !ctx.text_edit_focused(),
        swapped: model.swapped,
        reading: !displayed.jobs.openings.is_empty(),
        problem: model.dataset.problems.first().map(|(_, problem)| problem.as_str()),
        range: displayed.range(),
        computed_maps: displayed.computed_maps().map(AsRef::as_ref),
        photograph: displayed.photograph(),
        inspection: &model.inspection,
        losses: displayed.jobs.loss.finished(&model.materials, &model.loss_query()),
    }
}
