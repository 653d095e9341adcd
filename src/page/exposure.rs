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
