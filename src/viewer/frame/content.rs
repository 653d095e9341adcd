//! Content of the window: the panes, and the legend below them. It is what a saved picture of the view shows.

use eframe::egui;

use svbrdf_core::model::scene::Kind;

use crate::model::Model;
use crate::model::material::loaded::LoadedMaterial;
use crate::pane::Displayed;
use crate::pane::gpu_view::GpuView;
use crate::pane::legend::LegendStrip;
use crate::pane::viewport::{STRIP, Viewport};
use crate::widgets::bare;
use crate::widgets::numbers::digits;

/// Height of the caption of a picture that is saved, in points.
pub const CAPTION: f32 = 20.0;
/// Height of a row of the statistics, in points; three of them are in the legend of the window.
const ROW: f32 = 19.0;

/// Heights of the legend below which the panes have no room to spare for it.
const LOW: f32 = 4.0;

/// Draws the panes and what is below them.
pub fn ui(
    ui: &mut egui::Ui,
    shown: &Displayed<'_>,
    next: &mut Model,
    viewport: &mut Viewport,
    gpu: Option<&mut GpuView>,
) {
    if shown.is_picture {
        let grid = shown.model.materials.ground_truth().map(LoadedMaterial::grid);
        let magnification = grid.map(|grid| viewport.magnification(grid, &shown.model.view));
        let panel = bare(egui::Panel::bottom("caption"), ui).exact_size(CAPTION).resizable(false);
        panel.show(ui, |ui| caption(ui, shown.model, magnification));
    }
    let height = legend_height(shown);
    // Where there is none, its room stays: the panes do not move as it comes.
    let room = if height > 0.0 { height } else { reserve(shown, ui.available_height()) };
    if room >= 1.0 {
        let panel = bare(egui::Panel::bottom("strip"), ui).exact_size(room).resizable(false);
        panel.show(ui, |ui| {
            if height > 0.0 {
                LegendStrip::new(shown).ui(ui, next);
            }
        });
    }
    egui::CentralPanel::no_frame().show(ui, |ui| {
        viewport.ui(ui, shown, next, gpu);
    });
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

/// The height of the legend, 0 without one. A picture that is saved has every row of the statistics.
pub fn legend_height(shown: &Displayed<'_>) -> f32 {
    match shown.model.view.display.difference && compares(shown) {
        true if shown.is_picture => STRIP + ROW * shown.materials().len().saturating_sub(4) as f32,
        true => STRIP,
        false => 0.0,
    }
}

/// The room that is left free for the legend below the panes of the window; none in a low one, which the panes need.
pub fn reserve(shown: &Displayed<'_>, height: f32) -> f32 {
    let is_high = height >= LOW * STRIP;
    let is_free = is_high && compares(shown) && !shown.is_picture && legend_height(shown) == 0.0;
    if is_free { STRIP } else { 0.0 }
}

/// Whether there is something to compare: predictions, or a photograph.
fn compares(displayed: &Displayed<'_>) -> bool {
    !displayed.model.materials.predictions().is_empty() || displayed.photograph().is_some()
}
