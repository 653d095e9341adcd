//! Light, view and convention, as numbers.

use eframe::egui;

use crate::model::convention;
use crate::model::scene::{Kind, Scene};
use crate::viewer::command::Command;
use crate::viewer::state::{End, FARTHEST, LOWEST, ViewState, end, set_end};

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
                .on_hover_text("Light and view at positions: directions differ from texel to texel");
            ui.selectable_value(&mut scene.kind, Kind::Distant, "Distant")
                .on_hover_text("Light and view infinitely far: the same directions everywhere");
        });
        coordinates(ui, "Light", &mut scene, End::Light);
        coordinates(ui, "View", &mut scene, End::View);
        if scene != self.state.scene {
            commands.push(Command::SetScene(scene));
        }
        self.buttons(ui, &mut commands);
        self.convention(ui, &mut commands);
        commands
    }

    fn buttons(&self, ui: &mut egui::Ui, commands: &mut Vec<Command>) {
        ui.horizontal_wrapped(|ui| {
            let mut follows = self.highlight_follows;
            ui.checkbox(&mut follows, "Highlight follows")
                .on_hover_text("A left-drag puts the mirror highlight, not the light, under the pointer (H)");
            if follows != self.highlight_follows {
                commands.push(Command::ToggleHighlightFollows);
            }
            let copy = ui.button("Copy scene").on_hover_text("As JSON, in the form of a scene file (Ctrl+C)");
            if copy.clicked() {
                commands.push(Command::CopyScene);
            }
        });
    }

    fn convention(&self, ui: &mut egui::Ui, commands: &mut Vec<Command>) {
        let now = self.state.convention();
        ui.horizontal(|ui| {
            let label = ui.label("Convention");
            let combo = egui::ComboBox::from_id_salt("convention").selected_text(now.name).show_ui(ui, |ui| {
                for one in convention::ALL {
                    if ui.selectable_label(one.name == now.name, one.name).clicked() {
                        commands.push(Command::SetConvention(one.name));
                    }
                }
            });
            combo.response.labelled_by(label.id).on_hover_text(
                "What differs between the printed algorithms and the released codes: intensity, clamps, epsilon",
            );
        });
    }
}

/// Three numbers for one end of the scene.
fn coordinates(ui: &mut egui::Ui, name: &str, scene: &mut Scene, which: End) {
    let mut p = end(scene, which);
    let default = end(&ViewState::default().scene, which);
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
    if p != end(scene, which) {
        set_end(scene, which, p);
    }
}
