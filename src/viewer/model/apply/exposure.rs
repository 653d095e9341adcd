//! Automatic exposure: the brightest 1% of the rendering of the ground truth just clip.

use svbrdf_core::material::Material;
use svbrdf_core::model::brdf::Model as BrdfModel;
use svbrdf_core::render::render_texel;
use svbrdf_core::statistics::quantile;

use crate::viewer::model::Model;
use crate::viewer::model::exposed::Exposed;
use crate::viewer::model::material::source::Origin;
use crate::viewer::model::ranges::STOPS;
use crate::viewer::model::view::state::{AutoExposure, ViewState};

/// Most texels that are rendered to find the exposure.
const TEXELS: usize = 20_000;

/// Computes the exposure where its state asks for it. Called in every frame.
pub fn follow(model: &mut Model) {
    let Some(ground_truth) = model.materials.ground_truth() else { return };
    let is_here = |origin: &Origin| model.materials.all.iter().any(|one| one.read.origin == *origin);
    let now = Exposed::For {
        ground_truth: ground_truth.read.origin.clone(),
        scene: model.view.scene,
        convention: model.view.convention.clone(),
    };
    let is_due = match (model.view.display.auto_exposure, &model.exposed) {
        (AutoExposure::Off, _) | (AutoExposure::Once, Exposed::Restored) => false,
        (AutoExposure::Once, Exposed::For { ground_truth, .. }) => !is_here(ground_truth),
        (AutoExposure::Follow, exposed) => *exposed != now,
        (AutoExposure::Once, Exposed::Pending) => true,
    };
    if is_due {
        let ev = automatic(ground_truth.material(), &model.view);
        model.view.exposure_ev = ev.clamp(-STOPS, STOPS);
    }
    if is_due || model.exposed == Exposed::Restored {
        model.exposed = now;
    }
}

/// Exposes anew for a scene that was chosen, and not moved to by hand.
pub(super) fn choose_scene(model: &mut Model) {
    if model.view.display.auto_exposure == AutoExposure::Once {
        model.exposed = Exposed::Pending;
    }
}

/// The exposure at which the brightest 1% of the rendering's texels just clip.
fn automatic(material: &Material<f32>, state: &ViewState) -> f32 {
    let model = BrdfModel::from(&state.convention());
    let rays = state.scene.rays();
    let texels = material.width() * material.height();
    let mut brightest: Vec<f32> = (0..texels)
        .step_by(texels.div_ceil(TEXELS))
        .map(|i| {
            let rgb = render_texel(material, &model, &rays, i % material.width(), i / material.width());
            rgb.into_iter().fold(0.0, f32::max)
        })
        .collect();
    match quantile(&mut brightest, 0.99) {
        Some(white) if white > 0.0 => -(white as f32).log2(),
        _ => 0.0,
    }
}
