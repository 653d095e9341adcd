//! Commands about light, view and convention.

use eframe::egui;

use crate::model::scene::{Scene, SceneFile};
use crate::viewer::app::App;
use crate::viewer::command::SceneCommand;
use crate::viewer::endpoint;
use crate::viewer::message::Message;
use crate::viewer::pasted::{Pasted, pasted};

impl App {
    pub(super) fn apply_to_scene(&mut self, ctx: &egui::Context, command: SceneCommand) {
        let scene = &mut self.state.scene;
        match command {
            SceneCommand::Set(new) => *scene = new,
            SceneCommand::SetKind(kind) => endpoint::set_kind(scene, kind),
            SceneCommand::MoveOverPlane(endpoint, at) => endpoint::move_over_plane(scene, endpoint, at),
            SceneCommand::PutHighlight(at) => endpoint::put_highlight(scene, at),
            SceneCommand::ScaleHeight(endpoint, factor) => endpoint::scale_height(scene, endpoint, factor),
            SceneCommand::ScaleDistance(endpoint, factor) => {
                endpoint::scale_distance(scene, endpoint, factor)
            }
            SceneCommand::Orbit { endpoint, sideways, upwards } => {
                endpoint::orbit(scene, endpoint, sideways, upwards);
            }
            SceneCommand::ToggleHighlightFollows => {
                self.settings.highlight_follows = !self.settings.highlight_follows;
            }
            SceneCommand::ToggleViewHandle => self.settings.view_handle = !self.settings.view_handle,
            SceneCommand::Preset(preset) => preset.apply(scene),
            SceneCommand::Animate(animation) => {
                let starts =
                    animation.light && (!self.animation.light || animation.path != self.animation.path);
                self.animation = animation;
                if starts {
                    self.animation.start_light(&self.state.scene);
                }
            }
            SceneCommand::TogglePause => self.animation.paused = !self.animation.paused,
            SceneCommand::SetConvention(name) => self.state.convention = name.to_owned(),
            SceneCommand::Copy => {
                let text = scene_text(*scene);
                self.copy_text(ctx, text, "the scene as JSON");
            }
            SceneCommand::Paste(text) => match pasted(&text) {
                Ok(Pasted::Scene(pasted)) => *scene = pasted,
                Ok(Pasted::Files(paths)) => {
                    let command = self.opened_from_outside(paths);
                    self.apply_to_materials(ctx, command);
                }
                Err(problem) => self.report([Message::NotPasted(problem)]),
            },
        }
    }
}

/// The scene as a scene file of one scene.
pub(in crate::viewer) fn scene_text(scene: Scene) -> String {
    serde_json::to_string_pretty(&SceneFile { scenes: vec![scene] }).unwrap_or_default()
}
