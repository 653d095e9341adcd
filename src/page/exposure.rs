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

#[cfg(test)]
mod tests {
    use svbrdf_core::material::Planes;
    use svbrdf_core::model::convention::PRINTED;
    use svbrdf_core::model::scene::Kind;

    use super::*;

    /// A rough material of one diffuse colour.
    fn diffuse(value: f32) -> Material<f32> {
        let plane = |value: f32| vec![value; 16];
        let planes = Planes {
            normal: [plane(0.0), plane(0.0), plane(1.0)],
            diffuse: [value; 3].map(plane),
            specular: [0.0; 3].map(plane),
            roughness: plane(1.0),
        };
        Material::new("one colour", 4, 4, planes).unwrap()
    }

    #[test]
    fn a_material_has_an_exposure_of_its_own_beyond_four_stops_only() {
        let scene = Scene { kind: Kind::Distant, view: [0.0, 0.0, 1.0], light: [0.0, 0.0, 1.0] };
        let materials = [0.5, 0.5 / 8.0, 0.5 / 64.0, 1.0].map(diffuse);
        let all: Vec<&Material<f32>> = materials.iter().collect();
        assert_eq!(offsets(&all, &scene, &PRINTED), [0.0, 0.0, 6.0, 0.0]);
        assert_eq!(offsets(&[&materials[2], &materials[0]], &scene, &PRINTED), [0.0, -6.0]);
        assert_eq!([stops(6.0), stops(-6.0)], ["+6 EV", "\u{2212}6 EV"]);
    }
}
