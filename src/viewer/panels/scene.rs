//! Light, view and convention.

use eframe::egui;

use crate::model::convention;
use crate::model::scene::{Kind, Scene};
use crate::viewer::command::{Command, SceneCommand};
use crate::viewer::state::{Endpoint, FARTHEST, LOWEST, ViewState, endpoint, set_endpoint};

/// What the section shows.
#[derive(Debug)]
pub struct ScenePanel<'a> {
    pub state: &'a ViewState,
    pub highlight_follows: bool,
}

impl ScenePanel<'_> {
    pub fn ui(&self, ui: &mut egui::Ui) -> Vec<Command> {
        let mut commands = Vec::new();
        let mut scene = self.state.scene;
        ui.horizontal(|ui| {
            ui.selectable_value(&mut scene.kind, Kind::Near, "Near-field")
                .on_hover_text("Light and view at positions: each texel sees them in its own directions");
            ui.selectable_value(&mut scene.kind, Kind::Distant, "Distant")
                .on_hover_text("Light and view infinitely far away: the same directions at every texel");
        });
        coordinates(ui, "Light", &mut scene, Endpoint::Light);
        coordinates(ui, "View", &mut scene, Endpoint::View);
        if scene != self.state.scene {
            commands.push(SceneCommand::Set(scene).into());
        }
        self.buttons(ui, &mut commands);
        self.convention(ui, &mut commands);
        commands
    }

    fn buttons(&self, ui: &mut egui::Ui, commands: &mut Vec<Command>) {
        ui.horizontal_wrapped(|ui| {
            let mut follows = self.highlight_follows;
            ui.checkbox(&mut follows, "Highlight follows").on_hover_text(
                "A left-drag moves the mirror highlight under the pointer, instead of the light (H)",
            );
            if follows != self.highlight_follows {
                commands.push(SceneCommand::ToggleHighlightFollows.into());
            }
            let copy = ui
                .button("Copy scene")
                .on_hover_text("Copy the scene as JSON, the format of scene files (Ctrl+C)");
            if copy.clicked() {
                commands.push(SceneCommand::Copy.into());
            }
        });
    }

    fn convention(&self, ui: &mut egui::Ui, commands: &mut Vec<Command>) {
        let now = self.state.convention();
        ui.horizontal(|ui| {
            let label = ui.label("Convention");
            let combo =
                egui::ComboBox::from_id_salt("convention").selected_text(now.name).show_ui(ui, |ui| {
                    for one in convention::ALL {
                        if ui.selectable_label(one.name == now.name, one.name).clicked() {
                            commands.push(SceneCommand::SetConvention(one.name).into());
                        }
                    }
                });
            combo.response.labelled_by(label.id).on_hover_text(
                "Light intensity, clamps and epsilon: they differ between the papers and their released code",
            );
        });
    }
}

/// Three numbers for one endpoint of the scene.
fn coordinates(ui: &mut egui::Ui, name: &str, scene: &mut Scene, which: Endpoint) {
    let mut p = endpoint(scene, which);
    let default = endpoint(&ViewState::default().scene, which);
    ui.horizontal(|ui| {
        ui.add_sized([36.0, 18.0], egui::Label::new(name));
        for (axis, letter) in ["x", "y", "z"].into_iter().enumerate() {
            let lowest = if axis == 2 { LOWEST } else { -FARTHEST };
            super::number(ui, &format!("{name} {letter}"), &mut p[axis], default[axis], |drag| {
                drag.speed(0.01)
                    .range(lowest..=FARTHEST)
                    .fixed_decimals(3)
                    .prefix(format!("{letter} "))
                    .min_size(egui::vec2(74.0, 18.0))
            });
        }
    });
    if p != endpoint(scene, which) {
        set_endpoint(scene, which, p);
    }
}
