//! The photograph in the side panel: which one it is, how it was read, and the factor of each material.

pub mod compared;

use eframe::egui::{self, RichText};

use svbrdf_files::read::Albedo;

use crate::model::material::loaded::LoadedMaterial;
use crate::model::{Model, opening};
use crate::photograph::compared::DisplayedPhotograph;
use crate::widgets::named;

/// Height of the list of factors, in points.
const FACTORS: f32 = 76.0;

/// Draws the section of the photograph that is open beside `materials`; whether the panes compare with it.
pub fn ui(
    ui: &mut egui::Ui,
    displayed: &DisplayedPhotograph<'_>,
    materials: &[LoadedMaterial],
    is_compared: bool,
    next: &mut Model,
) {
    let source = displayed.source;
    ui.horizontal(|ui| {
        ui.strong("Photograph");
        ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
            let close = ui.small_button("Close photograph");
            if close.on_hover_text("Compare with the ground truth again").clicked() {
                next.photograph.set(None);
            }
            ui.with_layout(egui::Layout::left_to_right(egui::Align::Center), |ui| {
                name(ui, displayed, next);
            });
        });
    });
    let Some(photograph) = &displayed.photograph else {
        ui.add(egui::Spinner::new());
        return;
    };
    ui.horizontal(|ui| {
        let [width, height] = [photograph.image.width, photograph.image.height];
        ui.label(RichText::new(format!("{width} x {height} pixels,")).small());
        let mut transfer = source.transfer;
        let text = format!("{} {}", photograph.transfer.label(), photograph.transfer_from);
        let combo = egui::ComboBox::from_id_salt("photograph transfer").selected_text(text);
        let response = combo.show_ui(ui, |ui| {
            ui.selectable_value(&mut transfer, None, "auto: by the file");
            for one in [Albedo::Linear, Albedo::Srgb, Albedo::Gamma22] {
                ui.selectable_value(&mut transfer, Some(one), one.label());
            }
        });
        named(&response.response, "Transfer curve");
        response.response.on_hover_text("How the stored samples encode radiance");
        if transfer != source.transfer {
            next.photograph.change(|source| source.transfer = transfer);
        }
    });
    for note in &photograph.notes {
        ui.label(RichText::new(note.to_string()).small().color(ui.visuals().warn_fg_color));
    }
    if !is_compared {
        ui.weak("Maps and the error map are compared with the ground truth.");
    }
    factors(ui, materials, displayed);
    let mut falloff = source.falloff;
    ui.checkbox(&mut falloff, "Divide out falloff").on_hover_text(
        "Divides the photograph by the falloff of a point light, which the renderings do not have: for photographs with \
         a flash or lamp near the material",
    );
    if falloff != source.falloff {
        next.photograph.change(|source| source.falloff = falloff);
    }
}

/// Its name, or a choice of all that are listed with it.
fn name(ui: &mut egui::Ui, displayed: &DisplayedPhotograph<'_>, next: &mut Model) {
    let path = displayed.source.path.display().to_string();
    let Some((names, number)) = next.photograph.listed() else {
        ui.add(egui::Label::new(displayed.name()).truncate()).on_hover_text(path);
        return;
    };
    let mut chosen = number;
    let combo = egui::ComboBox::from_id_salt("photographs").truncate().width(ui.available_width());
    let response = combo.selected_text(names[chosen]).show_ui(ui, |ui| {
        for (index, name) in names.iter().enumerate() {
            ui.selectable_value(&mut chosen, index, *name);
        }
    });
    named(&response.response, "Photographs");
    response.response.on_hover_text(path);
    if chosen != number {
        opening::choose_photograph(next, chosen);
    }
}

/// The factor of each material, and what is left out.
fn factors(ui: &mut egui::Ui, materials: &[LoadedMaterial], displayed: &DisplayedPhotograph<'_>) {
    let Some(all) = displayed.all() else {
        ui.weak("Fitting the exposure...");
        return;
    };
    let hover = "Factor on the photograph: the median of rendering / photograph. It brings the photograph to the exposure \
                 of the rendering.";
    egui::ScrollArea::vertical().id_salt("photograph factors").max_height(FACTORS).show(ui, |ui| {
        for (material, one) in materials.iter().zip(&all.comparisons) {
            let left = |ui: &mut egui::Ui| drop(ui.label(RichText::new(material.name()).small()));
            let right = |ui: &mut egui::Ui| {
                for text in [format!("{:+.2} EV", one.exposure_ev()), format!("x {:.4}", one.factor)] {
                    ui.label(RichText::new(text).monospace().size(11.5)).on_hover_text(hover);
                }
            };
            egui::Sides::new().shrink_left().truncate().show(ui, left, right);
        }
    });
    if let Some(one) = all.get(0) {
        let clipped = one.clipped() as f64 / one.photograph.pixels.len() as f64;
        let text = RichText::new(format!("{:.2}% of the texels are clipped", 100.0 * clipped)).small();
        let text = if clipped > 0.05 { text.color(ui.visuals().warn_fg_color) } else { text };
        ui.label(text).on_hover_text(
            "They have a pixel at the largest value that the file can store. They are left out of the factor and of \
             every difference",
        );
    }
}
