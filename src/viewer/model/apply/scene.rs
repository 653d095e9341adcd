//! Commands about light, view and convention.

use svbrdf_core::model::scene::{Scene, SceneFile};

use super::exposure;
use crate::model::Model;
use crate::model::command::SceneCommand;
use crate::model::command::effect::Effect;
use crate::model::message::Message;
use crate::model::view::endpoint;

pub(super) fn apply(model: &mut Model, command: SceneCommand) -> Vec<Effect> {
    let scene = &mut model.view.scene;
    match command {
        SceneCommand::Set(new) => *scene = new,
        SceneCommand::Choose(new) => {
            *scene = new;
            exposure::choose_scene(model);
        }
        SceneCommand::SetKind(kind) => endpoint::set_kind(scene, kind),
        SceneCommand::MoveOverPlane(endpoint, at) => endpoint::move_over_plane(scene, endpoint, at),
        SceneCommand::PutHighlight(at) => endpoint::put_highlight(scene, at),
        SceneCommand::ScaleHeight(endpoint, factor) => endpoint::scale_height(scene, endpoint, factor),
        SceneCommand::ScaleDistance(endpoint, factor) => endpoint::scale_distance(scene, endpoint, factor),
        SceneCommand::Orbit { endpoint, sideways, upwards } => {
            endpoint::orbit(scene, endpoint, sideways, upwards);
        }
        SceneCommand::ToggleHighlightFollows => model.settings.highlight_follows ^= true,
        SceneCommand::SetConvention(convention) => model.use_convention(convention),
        SceneCommand::Copy => {
            return vec![Effect::CopyText { text: scene_text(*scene), what: "the scene as JSON" }];
        }
        SceneCommand::Paste(text) => match pasted(&text) {
            Ok(scene) => return apply(model, SceneCommand::Choose(scene)),
            Err(problem) => model.report([Message::Warning(problem)]),
        },
    }
    Vec::new()
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
fn scene_text(scene: Scene) -> String {
    serde_json::to_string_pretty(&SceneFile { scenes: vec![scene] }).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::view::state::ViewState;

    #[test]
    fn a_copied_scene_can_be_pasted() {
        let scene = ViewState::default().scene;
        assert_eq!(pasted(&scene_text(scene)), Ok(scene));
        let below = scene_text(Scene { light: [0.0, 0.0, -1.0], ..scene });
        for (text, problem) in
            [("{\"scenes\": []}", "no scene"), ("brown fox", "no scene"), (&below, "above the plane")]
        {
            assert!(pasted(text).unwrap_err().contains(problem), "{text}");
        }
    }
}
