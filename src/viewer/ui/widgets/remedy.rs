//! Button that reads a prediction again with the option that a diagnosis suggests.

use eframe::egui;

use svbrdf_evaluate::diagnose::Remedy;

use crate::model::material::loaded::LoadedMaterial;
use crate::model::{Model, opening};
use svbrdf_files::source::Place;

/// Whether a material can be read again with the option: one of a file that does not have it yet.
pub fn is_offered(material: &LoadedMaterial, remedy: Remedy) -> bool {
    let read = &material.read;
    let with = read.record.options.with_remedy(remedy);
    matches!(read.source.place, Place::Path(_)) && with.is_ok_and(|with| with != read.record.options)
}

/// The button for the material at `index`; a click reads it again, and shows it as it is read.
pub fn remedy_button(
    ui: &mut egui::Ui,
    index: usize,
    material: &LoadedMaterial,
    remedy: Remedy,
    next: &mut Model,
) {
    let words = remedy.to_string().replace("specular-albedo", "specular").replace(['-', '='], " ");
    let button = ui.small_button(format!("Read with {}", words.replace(',', ", ")));
    let hover = format!(
        "Read {} again with this option, as Change... in Files does; undo (Ctrl+Z) goes back. If the ground truth is the one that is \
         read wrongly, change it instead",
        material.name()
    );
    if button.on_hover_text(hover).clicked()
        && let Ok(read) = material.read.record.options.with_remedy(remedy)
    {
        next.view.correct(None);
        opening::read_as(next, index, read);
    }
}
