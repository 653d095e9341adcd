//! Scenes on the clipboard.

use svbrdf_core::model::scene::{Scene, SceneFile};

use crate::message::Message;
use crate::model::{Model, exposure};

/// Takes the scene of this text of the clipboard.
pub fn paste(model: &mut Model, text: &str) {
    match pasted(text) {
        Ok(scene) => exposure::choose_scene(model, scene),
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
pub fn text(scene: Scene) -> String {
    serde_json::to_string_pretty(&SceneFile { scenes: vec![scene] }).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::view::ViewState;

    #[test]
    fn a_copied_scene_can_be_pasted() {
        let scene = ViewState::default().scene;
        assert_eq!(pasted(&text(scene)), Ok(scene));
        let below = text(Scene { light: [0.0, 0.0, -1.0], ..scene });
        for (copied, problem) in
            [("{\"scenes\": []}", "no scene"), ("brown fox", "no scene"), (&below, "above the plane")]
        {
            assert!(pasted(copied).unwrap_err().contains(problem), "{copied}");
        }
    }
}
