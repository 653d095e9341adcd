//! The line at the bottom: the values of the texel under the pointer, and the graphics adapter.

use eframe::egui::{self, RichText};

use crate::gpu::AdapterReport;
use crate::material::Material;
use crate::model::brdf::Model;
use crate::model::convention::Convention;
use crate::picture::quantity::Quantity;
use crate::render::render_texel;
use crate::viewer::slots::Slot;
use crate::viewer::state::ViewState;

/// What the line shows.
#[derive(Debug)]
pub struct StatusBar<'a> {
    pub state: &'a ViewState,
    pub slots: &'a [Slot],
    pub hovered: Option<[f32; 2]>,
    /// `None` where there is no adapter.
    pub adapter: Option<&'a AdapterReport>,
    pub frame_ms: f32,
}

impl StatusBar<'_> {
    pub fn ui(&self, ui: &mut egui::Ui) {
        ui.horizontal(|ui| {
            ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
                ui.label(RichText::new(format!("{:5.1} ms", self.frame_ms)).monospace().weak())
                    .on_hover_text("CPU time of the last frame");
                if let Some(adapter) = self.adapter {
                    let name = egui::Label::new(RichText::new(&adapter.name).weak()).truncate();
                    ui.add_sized([150.0, 16.0], name).on_hover_text(adapter.to_string());
                }
                ui.with_layout(egui::Layout::left_to_right(egui::Align::Center), |ui| {
                    ui.add(egui::Label::new(RichText::new(self.readout()).monospace()).truncate());
                });
            });
        });
    }

    fn readout(&self) -> String {
        let texel = self.hovered.and_then(|p| {
            let ground_truth = self.slots.first()?;
            let [column, row] = ground_truth.loaded.material.grid().texel_at(p)?;
            Some((ground_truth, column, row))
        });
        let Some((ground_truth, column, row)) = texel else {
            return "texel -".to_owned();
        };
        let convention = self.state.convention();
        let value = |slot: &Slot| value(&slot.loaded.material, self.state, &convention, column, row);
        let expected = value(ground_truth);
        let mut text = format!("texel {column},{row}  gt {}", numbers(&expected));
        if let Some(prediction) = self.slots.get((self.state.prediction + 1).min(self.slots.len() - 1))
            && self.slots.len() > 1
        {
            let got = value(prediction);
            text += &format!("  pred {}", numbers(&got));
            if self.state.quantity == Quantity::Rendering {
                text += &format!("  |ln| {:.4}", log_difference(&expected, &got, convention.epsilon));
            }
        }
        text
    }
}

/// The rendering or map at one texel, from the core.
fn value(
    material: &Material<f32>,
    state: &ViewState,
    convention: &Convention,
    column: usize,
    row: usize,
) -> Vec<f32> {
    let texel = material.texel(row * material.width() + column);
    match state.quantity {
        Quantity::Rendering => {
            render_texel(material, &Model::from(convention), &state.scene.rays(), column, row).to_vec()
        }
        Quantity::Normal => texel.normal.to_array().to_vec(),
        Quantity::Diffuse => texel.diffuse.to_vec(),
        Quantity::Specular => texel.specular.to_vec(),
        Quantity::Roughness => vec![texel.roughness],
    }
}

fn numbers(values: &[f32]) -> String {
    values.iter().map(|v| format!("{v:7.4}")).collect::<Vec<_>>().join(" ")
}

/// The mean over RGB of |ln(a + epsilon) - ln(b + epsilon)|.
fn log_difference(a: &[f32], b: &[f32], epsilon: f64) -> f64 {
    let log = |x: f32| (f64::from(x) + epsilon).ln();
    a.iter().zip(b).map(|(a, b)| (log(*a) - log(*b)).abs()).sum::<f64>() / a.len() as f64
}
