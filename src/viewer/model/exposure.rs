//! Automatic exposure: the brightest 1% of the rendering of the ground truth just clip.

use svbrdf_core::model::scene::Scene;
use svbrdf_core::picture::exposure;
use svbrdf_files::source::Place;

use crate::model::Model;
use crate::model::view::{AutoExposure, Exposed, STOPS};

/// Computes the exposure where its state asks for it. Called in every frame.
pub fn follow(model: &mut Model) {
    let Some(ground_truth) = model.materials.ground_truth() else { return };
    let is_here = |place: &Place| model.materials.all.iter().any(|one| one.read.source.place == *place);
    let now = Exposed::For {
        ground_truth: ground_truth.read.source.place.clone(),
        scene: model.view.scene,
        convention: model.view.convention(),
    };
    let is_due = match (model.view.display.auto_exposure, &model.exposed) {
        (AutoExposure::Off, _) | (AutoExposure::Once, Exposed::Restored) => false,
        (AutoExposure::Once, Exposed::For { ground_truth, .. }) => !is_here(ground_truth),
        (AutoExposure::Follow, exposed) => *exposed != now,
        (AutoExposure::Once, Exposed::Pending) => true,
    };
    if is_due {
        let convention = model.view.convention().drawn();
        let ev = exposure::automatic(ground_truth.material(), &model.view.scene, &convention);
        model.view.exposure_ev = ev.clamp(-STOPS, STOPS);
    }
    if is_due || model.exposed == Exposed::Restored {
        model.exposed = now;
    }
}

/// Chooses how the exposure is automatic; it is computed at once.
pub fn choose(model: &mut Model, auto: AutoExposure) {
    (model.view.display.auto_exposure, model.exposed) = (auto, Exposed::Pending);
}

/// Shows a scene that was picked from a list, and exposes for it where the exposure is automatic.
pub fn choose_scene(model: &mut Model, scene: Scene) {
    model.view.scene = scene;
    if model.view.display.auto_exposure == AutoExposure::Once {
        model.exposed = Exposed::Pending;
    }
}
