//! The strip below the panes that show values: the histogram of each channel, of every material.

use eframe::egui::{self, Align2, Color32, FontId, Sense, Stroke, vec2};

use svbrdf_core::picture::quantity::Quantity;

use crate::jobs::displayed::Displayed;
use crate::jobs::panes::histograms::{Channel, Values};
use crate::model::material::loaded::LoadedMaterial;
use crate::ui::legend::strip::{axes, beyond, outline};
use crate::ui::widgets::bounds::inset;
use crate::ui::widgets::numbers::digits;
use crate::ui::widgets::theme;

/// Height of a histogram, in points.
const HEIGHT: f32 = 60.0;

/// What the strip shows.
#[derive(Debug)]
pub struct ValueStrip<'a> {
    pub quantity: Quantity,
    /// The histograms, and whether they are up to date.
    pub values: Option<(&'a Values, bool)>,
    /// Of all materials.
    pub names: Vec<&'a str>,
    /// The slot of the chosen prediction.
    pub chosen: usize,
}

impl<'a> ValueStrip<'a> {
    /// The strip for what is displayed.
    pub fn new(displayed: Displayed<'a>) -> Self {
        let (view, materials) = (&displayed.model.view, displayed.materials());
        Self {
            quantity: view.display.quantity,
            values: displayed.jobs.panes.histograms.get(materials, view),
            names: materials.iter().map(LoadedMaterial::name).collect(),
            chosen: view.display.prediction + 1,
        }
    }

    pub fn ui(&self, ui: &mut egui::Ui) {
        let Some((values, current)) = self.values else {
            ui.weak("Computing histograms...");
            return;
        };
        if !current {
            ui.set_opacity(0.5);
        }
        let letters: &[&str] = match self.quantity {
            Quantity::Normal => &["x", "y", "z"],
            Quantity::Roughness => &[""],
            _ => &["red", "green", "blue"],
        };
        let width = (ui.available_width() - 16.0) / values.len() as f32 - 8.0;
        ui.horizontal(|ui| {
            for (letter, channel) in letters.iter().zip(values) {
                self.channel(ui, letter, channel, width.max(60.0));
            }
        });
    }

    fn channel(&self, ui: &mut egui::Ui, letter: &str, channel: &[Channel], width: f32) {
        let (response, painter) = ui.allocate_painter(vec2(width, HEIGHT + 14.0), Sense::hover());
        response.widget_info(|| {
            egui::WidgetInfo::labeled(egui::Role::Image, true, format!("Histogram of {letter}"))
        });
        let area = response.rect.with_max_y(response.rect.top() + HEIGHT);
        let ink = ui.visuals().weak_text_color();
        painter.rect_stroke(area, 0.0, Stroke::new(1.0, ink.gamma_multiply(0.4)), egui::StrokeKind::Inside);
        let inner = inset(area, vec2(2.0, 2.0));
        for (slot, one) in channel.iter().enumerate() {
            let width = if slot == self.chosen || slot == 0 { 1.8 } else { 1.0 };
            let line = outline(&one.histogram, inner);
            let stroke = Stroke::new(width, colour(slot, ui.visuals()));
            painter.extend(theme::series_line(&line, slot.saturating_sub(1), stroke));
            painter.extend(beyond(&one.histogram, inner, stroke.color));
        }
        key(&painter, area, channel.len(), ui.visuals());
        if let Some(first) = channel.first() {
            let font = FontId::monospace(11.0);
            let (low, high) = (digits(first.histogram.low), digits(first.histogram.high));
            painter.text(area.left_bottom(), Align2::LEFT_TOP, low, font.clone(), ink);
            painter.text(area.right_bottom(), Align2::RIGHT_TOP, high, font, ink);
            let what = axes(format!("{} {letter}", self.quantity.name()).trim());
            painter.text(area.center_bottom(), Align2::CENTER_TOP, what, FontId::proportional(11.0), ink);
        }
        response.on_hover_ui(|ui| self.numbers(ui, letter, channel));
    }

    fn numbers(&self, ui: &mut egui::Ui, letter: &str, channel: &[Channel]) {
        ui.label(format!("{letter}: counts are logarithmic"));
        egui::Grid::new("values").show(ui, |ui| {
            for head in ["", "mean", "min", "median", "95%", "max", "beyond"] {
                ui.weak(head);
            }
            ui.end_row();
            for (slot, one) in channel.iter().enumerate() {
                let name = self.names.get(slot).copied().unwrap_or_default();
                ui.colored_label(colour(slot, ui.visuals()), name);
                if let Some(s) = one.statistics {
                    for value in [s.mean, s.minimum, s.median, s.p95, s.maximum] {
                        ui.monospace(digits(value));
                    }
                }
                ui.monospace((one.histogram.below + one.histogram.above).to_string());
                ui.end_row();
            }
        });
    }
}

/// The numbers of the materials in their colours, in the upper right corner; "gt" is the ground truth.
fn key(painter: &egui::Painter, area: egui::Rect, count: usize, visuals: &egui::Visuals) {
    let font = FontId::monospace(11.0);
    let mut at = area.right_top() + vec2(-5.0, 3.0);
    for slot in (0..count).rev() {
        let text = if slot == 0 { "gt".to_owned() } else { slot.to_string() };
        let place = painter.text(at, Align2::RIGHT_TOP, text, font.clone(), colour(slot, visuals));
        at.x = place.left() - 5.0;
    }
}

/// The colour of a material's histogram: the ground truth's is that of text.
fn colour(slot: usize, visuals: &egui::Visuals) -> Color32 {
    match slot.checked_sub(1) {
        None => theme::ground_truth(visuals),
        Some(prediction) => theme::series(prediction, visuals.dark_mode),
    }
}
