//! The menu of the bar: what is seldom used; and the scale of text and controls, which the monitor chooses at the first start.

use std::collections::BTreeSet;

use eframe::egui;

use svbrdf_gpu::Gpu;

use crate::error::Error;
use crate::frame::blind;
use crate::jobs::Shown;
use crate::jobs::answers::{Pace, Question, Work};
use crate::model::Model;
use crate::widgets::answered;

/// The scales of text and controls that the menu offers, in percent.
const SCALES: [u16; 8] = [75, 100, 125, 150, 175, 200, 250, 300];

pub fn ui(ui: &mut egui::Ui, Shown { model, jobs }: Shown<'_>, next: &mut Model) {
    if let Some(open) = &model.dataset.open {
        let list = format!("List of {}s  (A)", open.noun());
        ui.toggle_value(&mut next.dataset.list.is_open, list).on_hover_text("Beside the panes");
        ui.separator();
    }
    compare_blind(ui, model, next);
    let theme = if model.settings.dark { "Light theme" } else { "Dark theme" };
    if ui.button(theme).on_hover_text("Colours of the window").clicked() {
        next.settings.dark ^= true;
        ui.close();
    }
    let scales = ui.menu_button("UI scale", |ui| {
        for percent in SCALES {
            let scale = f32::from(percent) / 100.0;
            let is_current = (model.settings.ui_scale - scale).abs() < 1e-3;
            if ui.selectable_label(is_current, format!("{percent}%")).clicked() {
                ui.ctx().set_zoom_factor(scale);
                ui.close();
            }
        }
    });
    let hover = "Size of text and controls (Ctrl with plus, minus)";
    scales.response.on_hover_text(hover);
    let adapters = ui.menu_button("Graphics adapter", |ui| {
        ui.set_max_width(260.0);
        let chosen = &mut next.settings.adapter;
        ui.selectable_value(chosen, None, "Automatic");
        answered(ui, jobs.answers.get(&ListAdapters), |ui, names| {
            for name in names {
                ui.selectable_value(chosen, Some(name.clone()), name);
            }
        });
        if cfg!(target_os = "macos") {
            ui.separator();
            ui.label(
                "A wide screen may display colours as Display P3: too saturated. Saved PNG files are right.",
            );
        }
    });
    adapters.response.on_hover_text("That of the next start; `--adapter` counts before it");
}

/// What the chosen prediction can be compared with blind.
fn compare_blind(ui: &mut egui::Ui, model: &Model, next: &mut Model) {
    let Some(chosen) = model.chosen_prediction() else { return };
    let menu = ui.menu_button("Compare blind", |ui| {
        for (index, other) in model.materials.all.iter().enumerate() {
            let name = format!("{}  {}", other.number(), other.name());
            if other.id() != chosen.id() && ui.button(name).clicked() {
                blind::start(next, index);
                ui.close();
            }
        }
    });
    let hover = "Is X the chosen prediction, or this? 20 trials without names (ABX)";
    menu.response.on_hover_text(hover);
}

/// The names of the graphics adapters.
#[derive(Clone, Debug, PartialEq)]
struct ListAdapters;

impl Question for ListAdapters {
    type Answer = BTreeSet<String>;
    const PACE: Pace = Pace::Beside;
    const HAS_MESSAGE: bool = false;

    fn answer(&self, _: &Work<'_, Self::Answer>) -> Result<BTreeSet<String>, Error> {
        Ok(Gpu::adapters()?.into_iter().map(|one| one.name).collect())
    }
}

/// Chooses the scale, once the monitor is known: systems without one of their own draw text of 2 mm on a 4K screen.
pub fn suit(ctx: &egui::Context, is_to_be_chosen: &mut bool) {
    let (monitor, native) = ctx.input(|i| (i.viewport().monitor_size, i.viewport().native_pixels_per_point));
    let Some(monitor) = monitor.filter(|_| std::mem::take(is_to_be_chosen)) else { return };
    if native.is_none_or(|native| native <= 1.0) {
        ctx.set_zoom_factor(scale_of_monitor(monitor.y * ctx.pixels_per_point()));
    }
}

/// In quarters, for a monitor of this height in pixels: 1 up to 1080.
fn scale_of_monitor(height: f32) -> f32 {
    ((height / 1080.0 * 4.0).floor() / 4.0).clamp(1.0, 3.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_large_monitor_has_larger_text_at_the_first_start() {
        let scales = [600.0, 1080.0, 1200.0, 1440.0, 2160.0, 4320.0].map(scale_of_monitor);
        assert_eq!(scales, [1.0, 1.0, 1.0, 1.25, 2.0, 3.0]);
    }
}
