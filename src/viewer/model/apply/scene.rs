//! Commands about light, view and convention.

use super::exposure;
use crate::model::Model;
use crate::model::command::effect::Effect;
use crate::model::command::{MaterialsCommand, SceneCommand};
use crate::model::message::pasted::{Pasted, pasted, scene_text};
use crate::model::message::{Message, PasteProblem};
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
        SceneCommand::ToggleViewHandle => model.settings.view_handle ^= true,
        SceneCommand::Preset(preset) => {
            preset.apply(scene);
            exposure::choose_scene(model);
        }
        SceneCommand::Animate(animation) => {
            let current = &mut model.animation;
            let starts = animation.light && (!current.light || animation.path != current.path);
            *current = animation;
            if starts {
                current.start_light(scene);
            }
        }
        SceneCommand::TogglePause => model.animation.paused ^= true,
        SceneCommand::SetConvention(convention) => model.use_convention(convention),
        SceneCommand::Copy => {
            return vec![Effect::CopyText { text: scene_text(*scene), what: "the scene as JSON" }];
        }
        SceneCommand::Paste(text) => return paste(model, &text),
        SceneCommand::PastePicture => model.report([Message::NotPasted(PasteProblem::Picture)]),
    }
    Vec::new()
}

fn paste(model: &mut Model, text: &str) -> Vec<Effect> {
    match pasted(text) {
        Ok(Pasted::Scene(scene)) => return model.apply(SceneCommand::Choose(scene).into()),
        Ok(Pasted::Files(paths)) => {
            let replace = model.materials.only_built_in();
            let read = model.materials.read_of_added();
            let open = MaterialsCommand::Open { paths, replace, read };
            return model.apply(open.into());
        }
        Err(problem) => model.report([Message::NotPasted(problem)]),
    }
    Vec::new()
}
