//! Commands about light, view and convention.

use eframe::egui;

use crate::model::scene::{Scene, SceneFile};
use crate::viewer::app::App;
use crate::viewer::command::SceneCommand;
use crate::viewer::endpoint;
use crate::viewer::message::{Message, PasteProblem};

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
            SceneCommand::Paste(text) => match pasted_scene(&text) {
                Ok(pasted) => *scene = pasted,
                Err(problem) => self.report([Message::NotPasted(problem)]),
            },
        }
    }
}

/// The scene as a scene file of one scene.
fn scene_text(scene: Scene) -> String {
    serde_json::to_string_pretty(&SceneFile { scenes: vec![scene] }).unwrap_or_default()
}

/// The first scene of a scene file, or a scene alone.
fn pasted_scene(text: &str) -> Result<Scene, PasteProblem> {
    let scene = serde_json::from_str::<SceneFile>(text)
        .ok()
        .and_then(|file| file.scenes.first().copied())
        .or_else(|| serde_json::from_str(text).ok())
        .ok_or(PasteProblem::NoScene)?;
    scene.check().map_err(PasteProblem::Unusable)?;
    Ok(scene)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::viewer::state::ViewState;

    #[test]
    fn a_copied_scene_can_be_pasted() {
        let scene = ViewState::default().scene;
        assert_eq!(pasted_scene(&scene_text(scene)), Ok(scene));
        assert_eq!(pasted_scene("{\"scenes\": []}"), Err(PasteProblem::NoScene));
        let below = scene_text(Scene { light: [0.0, 0.0, -1.0], ..scene });
        let Err(PasteProblem::Unusable(problem)) = pasted_scene(&below) else { panic!("it is below") };
        assert!(problem.contains("above the plane"), "{problem}");
    }
}
