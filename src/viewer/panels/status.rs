//! The line at the bottom: the values of the texel under the pointer, and the graphics adapter.

use eframe::egui::{self, RichText};

use crate::gpu::AdapterReport;
use crate::material::Material;
use crate::model::brdf::Model;
use crate::model::convention::Convention;
use crate::picture::quantity::Quantity;
use crate::render::render_texel;
use crate::viewer::panes::Hovered;
use crate::viewer::slots::Slot;
use crate::viewer::state::ViewState;

/// What the line shows.
#[derive(Debug)]
pub struct StatusBar<'a> {
    pub state: &'a ViewState,
    pub slots: &'a [Slot],
    pub hovered: Option<Hovered>,
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

    /// The values at the texel under the pointer: of the ground truth, and of the prediction in the pane there (in that
    /// of the ground truth: the chosen one).
    fn readout(&self) -> String {
        let texel = self.hovered.and_then(|hovered| {
            let ground_truth = self.slots.first()?;
            Some((hovered.slot, ground_truth, ground_truth.loaded.material.grid().texel_at(hovered.point)?))
        });
        let Some((hovered, ground_truth, [column, row])) = texel else {
            return "texel -".to_owned();
        };
        let convention = self.state.convention();
        let value = |slot: &Slot| value(&slot.loaded.material, self.state, &convention, [column, row]);
        let expected = value(ground_truth);
        let mut text = format!("texel {column:4},{row:4}  gt {}", self.numbers(expected));
        let number = if hovered == 0 { self.state.prediction + 1 } else { hovered };
        if let Some(prediction) = self.slots.get(number) {
            let got = value(prediction);
            let kind = self.state.difference_kind();
            let difference = kind.of_texel(expected, got, convention.epsilon);
            text += &format!("  {number} {}  {} {difference:.4}", self.numbers(got), kind.unit());
        }
        text
    }

    /// The numbers of a value; of roughness only one.
    fn numbers(&self, value: [f32; 3]) -> String {
        let count = if self.state.quantity == Quantity::Roughness { 1 } else { 3 };
        value[..count].iter().map(|v| format!("{v:7.4}")).collect::<Vec<_>>().join(" ")
    }
}

/// The rendering or map at one texel, from the core.
fn value(
    material: &Material<f32>,
    state: &ViewState,
    convention: &Convention,
    [column, row]: [usize; 2],
) -> [f32; 3] {
    let texel = material.texel(row * material.width() + column);
    match state.quantity {
        Quantity::Rendering => {
            render_texel(material, &Model::from(convention), &state.scene.rays(), column, row)
        }
        Quantity::Normal => texel.normal.to_array(),
        Quantity::Diffuse => texel.diffuse,
        Quantity::Specular => texel.specular,
        Quantity::Roughness => [texel.roughness; 3],
    }
}
