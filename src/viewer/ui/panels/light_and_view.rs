//! Light, view and convention.

use eframe::egui;

use svbrdf_core::model::convention;
use svbrdf_core::model::scene::{Kind, Scene};

use crate::viewer::model::command::{Command, SceneCommand};
use crate::viewer::model::settings::Settings;
use crate::viewer::model::view::animation::{Animation, Path, Preset};
use crate::viewer::model::view::endpoint::{Endpoint, FARTHEST, LOWEST, endpoint, set_endpoint};
use crate::viewer::model::view::state::ViewState;
use crate::viewer::ui::widgets::number;

/// What the section shows.
#[derive(Debug)]
pub struct ScenePanel<'a> {
    pub state: &'a ViewState,
    pub settings: &'a Settings,
    pub animation: &'a Animation,
}

impl ScenePanel<'_> {
    pub fn ui(&self, ui: &mut egui::Ui) -> Vec<Command> {
        let mut commands = Vec::new();
        let mut scene = self.state.scene;
        ui.horizontal(|ui| {
            for (kind, name, hover) in [
                (
                    Kind::Near,
                    "Near-field",
                    "Light and view at positions: each texel sees them in its own directions",
                ),
                (
                    Kind::Distant,
                    "Distant",
                    "Light and view infinitely far away: the same directions at every texel",
                ),
            ] {
                let choice = ui.selectable_label(scene.kind == kind, name).on_hover_text(hover);
                if choice.clicked() && scene.kind != kind {
                    commands.push(SceneCommand::SetKind(kind).into());
                }
            }
        });
        coordinates(ui, "Light", &mut scene, Endpoint::Light);
        coordinates(ui, "View", &mut scene, Endpoint::View);
        if scene != self.state.scene {
            commands.push(SceneCommand::Set(scene).into());
        }
        self.presets(ui, &mut commands);
        self.motion(ui, &mut commands);
        self.buttons(ui, &mut commands);
        self.convention(ui, &mut commands);
        commands
    }

    fn presets(&self, ui: &mut egui::Ui, commands: &mut Vec<Command>) {
        ui.horizontal_wrapped(|ui| {
            for preset in Preset::ALL {
                let [name, meaning] = preset.texts();
                if ui.small_button(name).on_hover_text(meaning).clicked() {
                    commands.push(SceneCommand::Preset(preset).into());
                }
            }
        });
    }

    /// What moves by itself.
    fn motion(&self, ui: &mut egui::Ui, commands: &mut Vec<Command>) {
        let mut animation = *self.animation;
        ui.horizontal_wrapped(|ui| {
            ui.checkbox(&mut animation.light, "Move light")
                .on_hover_text("The light follows a path by itself");
            let combo = egui::ComboBox::from_id_salt("path").width(96.0).selected_text(animation.path.name());
            let combo = combo.show_ui(ui, |ui| {
                for path in Path::ALL {
                    ui.selectable_value(&mut animation.path, path, path.name());
                }
            });
            combo
                .response
                .widget_info(|| egui::WidgetInfo::labeled(egui::Role::ComboBox, true, "Path of the light"));
            ui.checkbox(&mut animation.turntable, "Turntable")
                .on_hover_text("The view turns about the upright axis of the material");
        });
        // Always there: what was clicked on stays in its place.
        ui.add_enabled_ui(animation.light || animation.turntable, |ui| {
            ui.horizontal(|ui| {
                number(ui, "Speed", &mut animation.speed, 1.0, |drag| {
                    drag.speed(0.02).range(0.05..=10.0).fixed_decimals(2).prefix("x ")
                })
                .on_hover_text("At 1 a circle takes 6 seconds");
                let name = if animation.paused { "Resume" } else { "Pause" };
                if ui.small_button(name).on_hover_text("Space").clicked() {
                    commands.push(SceneCommand::TogglePause.into());
                }
            });
        });
        if animation != *self.animation {
            let started =
                animation.light && !self.animation.light || animation.turntable && !self.animation.turntable;
            animation.paused &= !started;
            commands.push(SceneCommand::Animate(animation).into());
        }
    }

    fn buttons(&self, ui: &mut egui::Ui, commands: &mut Vec<Command>) {
        ui.horizontal_wrapped(|ui| {
            let mut follows = self.settings.highlight_follows;
            ui.checkbox(&mut follows, "Highlight follows").on_hover_text(
                "A left-drag moves the mirror highlight under the pointer, instead of the light (H)",
            );
            if follows != self.settings.highlight_follows {
                commands.push(SceneCommand::ToggleHighlightFollows.into());
            }
            let mut handle = self.settings.view_handle;
            ui.checkbox(&mut handle, "View handle")
                .on_hover_text("The eye in flat panes, which moves the view");
            if handle != self.settings.view_handle {
                commands.push(SceneCommand::ToggleViewHandle.into());
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
            number(ui, &format!("{name} {letter}"), &mut p[axis], default[axis], |drag| {
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
