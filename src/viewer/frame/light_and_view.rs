//! Light, view and convention, and scenes on the clipboard.

use eframe::egui::{self, Sense, vec2};

use svbrdf_core::model::convention::Convention;
use svbrdf_core::model::named_conventions as conventions;
use svbrdf_core::model::scene::{Kind, Scene, SceneFile};
use svbrdf_files::convention::ChosenConvention;

use crate::message::Message;
use crate::model::dialogs::OpenDialog;
use crate::model::endpoint::{Endpoint, FARTHEST, LOWEST, endpoint, set_endpoint, set_kind};
use crate::model::material::loaded::drawable;
use crate::model::view::ViewState;
use crate::model::{Model, display};
use crate::widgets::{copy, named, number};

/// Widths of a number and of the name of an endpoint, in points.
const NUMBER: f32 = 70.0;
const NAME: f32 = 14.0;

/// Draws the scene and the convention of the panes.
pub fn ui(ui: &mut egui::Ui, model: &Model, next: &mut Model) {
    ui.spacing_mut().item_spacing = vec2(4.0, 3.0);
    ui.horizontal(|ui| kinds(ui, &mut next.view.scene));
    coordinates(ui, "Light", &mut next.view.scene, Endpoint::Light);
    coordinates(ui, "View", &mut next.view.scene, Endpoint::View);
    convention(ui, model, next);
    ui.horizontal(|ui| {
        ui.checkbox(&mut next.settings.highlight_follows, "Highlight follows").on_hover_text(
            "A left-drag moves the mirror highlight under the pointer, instead of the light (H)",
        );
        let hover = "Copy the scene as JSON, the format of scene files (Ctrl+C)";
        if ui.button("Copy scene").on_hover_text(hover).clicked() {
            copy(ui.ctx(), next, scene_text(model.view.scene), "the scene as JSON");
        }
    });
}

fn kinds(ui: &mut egui::Ui, scene: &mut Scene) {
    for (kind, name, hover) in [
        (Kind::Near, "Near-field", "Light and view at positions: each texel sees them in its own directions"),
        (Kind::Distant, "Distant", "Light and view infinitely far away: the same directions at every texel"),
    ] {
        if ui.selectable_label(scene.kind == kind, name).on_hover_text(hover).clicked() {
            set_kind(scene, kind);
        }
    }
}

/// The choice of the convention.
fn convention(ui: &mut egui::Ui, model: &Model, next: &mut Model) {
    let now = &model.view.convention;
    ui.horizontal(|ui| {
        let combo =
            egui::ComboBox::from_id_salt("convention").selected_text(label(now)).width(140.0).height(300.0);
        let combo = combo.show_ui(ui, |ui| {
            let published = conventions::all().iter().filter_map(|one| {
                let convention = Convention::try_from(one).ok()?;
                Some((ChosenConvention::from(convention), conventions::summary(one)))
            });
            let of_files = model.conventions.iter().map(|one| (one.clone(), one.argument()));
            for (one, hover) in published.chain(of_files) {
                if ui.selectable_label(one == *now, label(&one)).on_hover_text(hover).clicked() {
                    next.use_convention(one);
                }
            }
            let open = ui.selectable_label(false, "Convention file...");
            let hover = "Render and compare by the convention in a file (TOML, as `svbrdf conventions NAME` prints one)";
            if open.on_hover_text(hover).clicked() {
                next.dialogs.open = Some(OpenDialog::default());
            }
        });
        named(&combo.response, "Convention");
        combo.response.on_hover_text(
            "Convention: the renderer, its light, clamps and epsilon: they differ from code to code",
        );
    });
}

/// The name of a convention, or of its file.
fn label(chosen: &ChosenConvention) -> String {
    let file = chosen.file.as_ref().and_then(|file| file.file_name());
    file.map_or_else(|| chosen.to_string(), |file| drawable(&file.to_string_lossy()))
}

/// Three numbers for one endpoint of the scene.
fn coordinates(ui: &mut egui::Ui, name: &str, scene: &mut Scene, which: Endpoint) {
    let mut p = endpoint(scene, which);
    let default = endpoint(&ViewState::default().scene, which);
    ui.horizontal(|ui| {
        let (area, icon) = ui.allocate_exact_size(vec2(NAME, 18.0), Sense::hover());
        let letter = if which == Endpoint::Light { "L" } else { "V" };
        let (font, ink) = (egui::FontId::proportional(13.0), ui.visuals().text_color());
        ui.painter().text(area.left_center(), egui::Align2::LEFT_CENTER, letter, font, ink);
        icon.on_hover_text(name);
        for (axis, letter) in ["x", "y", "z"].into_iter().enumerate() {
            let lowest = if axis == 2 { LOWEST } else { -FARTHEST };
            number(ui, &format!("{name} {letter}"), &mut p[axis], default[axis], |drag| {
                drag.speed(0.01)
                    .range(lowest..=FARTHEST)
                    .fixed_decimals(3)
                    .prefix(format!("{letter} "))
                    .min_size(vec2(NUMBER, 18.0))
            })
            .on_hover_text(format!(
                "{letter} of the {}: drag, or click to type; double-click for its default",
                name.to_lowercase()
            ));
        }
    });
    if p != endpoint(scene, which) {
        set_endpoint(scene, which, p);
    }
}

/// Takes the scene of this text of the clipboard.
pub fn paste(model: &mut Model, text: &str) {
    match pasted(text) {
        Ok(scene) => display::choose_scene(model, scene),
        Err(problem) => model.report([Message::Warning(problem)]),
    }
}

/// The first scene of a scene file, or a scene alone.
fn pasted(text: &str) -> Result<Scene, String> {
    let of_file = serde_json::from_str::<SceneFile>(text).ok().and_then(|file| file.scenes.first().copied());
    let Some(scene) = of_file.or_else(|| serde_json::from_str(text).ok()) else {
        let remedy = "Copy one from this window or from a scene file.";
        return Err(format!("Not pasted: the clipboard holds no scene. {remedy}"));
    };
    scene.check().map_err(|problem| format!("Not pasted: the scene cannot be rendered, {problem}."))?;
    Ok(scene)
}

/// The scene as a scene file of one scene.
pub fn scene_text(scene: Scene) -> String {
    serde_json::to_string_pretty(&SceneFile { scenes: vec![scene] }).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_copied_scene_can_be_pasted() {
        let scene = ViewState::default().scene;
        assert_eq!(pasted(&scene_text(scene)), Ok(scene));
        let below = scene_text(Scene { light: [0.0, 0.0, -1.0], ..scene });
        for (copied, problem) in
            [("{\"scenes\": []}", "no scene"), ("brown fox", "no scene"), (&below, "above the plane")]
        {
            assert!(pasted(copied).unwrap_err().contains(problem), "{copied}");
        }
    }
}
