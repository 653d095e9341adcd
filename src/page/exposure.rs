//! Exposure of the figure and of thumbnails.

use svbrdf_core::material::Material;
use svbrdf_core::model::convention::Convention;
use svbrdf_core::model::scene::Scene;
use svbrdf_core::picture::exposure::automatic;

/// Largest exposure of the figure, in stops, in either direction.
const MOST_STOPS: f32 = 8.0;

/// The exposure in stops at which the brightest 1% of a rendering of the ground truth just clip, to a step of the figure's control.
pub fn exposure(ground_truth: &Material<f32>, scene: &Scene, convention: &Convention) -> f32 {
    ((2.0 * automatic(ground_truth, scene, convention)).round() / 2.0).clamp(-MOST_STOPS, MOST_STOPS)
}

/// Stops between two materials from which one exposure shows only one of them.
const FAR_APART: f32 = 4.0;

/// The stops by which each material is brightened beside the first: 0 unless its brightness differs by more than 4.
pub(super) fn offsets(materials: &[&Material<f32>], scene: &Scene, convention: &Convention) -> Vec<f32> {
    let stops: Vec<f32> = materials.iter().map(|one| automatic(one, scene, convention)).collect();
    let offset = |own: &f32| (2.0 * (own - stops[0])).round() / 2.0;
    stops.iter().map(offset).map(|offset| if offset.abs() > FAR_APART { offset } else { 0.0 }).collect()
}

/// Stops with their sign.
pub(super) fn stops(ev: f32) -> String {
    format!("{}{} EV", if ev < 0.0 { '\u{2212}' } else { '+' }, ev.abs())
}
