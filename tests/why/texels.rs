//! The loss over texels, and over scenes.

use svbrdf_core::error::Error;
use svbrdf_core::image::Image;
use svbrdf_core::loss::{Comparison, Request, Sampling};
use svbrdf_core::material::Material;
use svbrdf_core::model::convention::Convention;
use svbrdf_core::model::grammar::Description;
use svbrdf_core::model::grammar::words::Norm;
use svbrdf_core::model::named_conventions as named;
use svbrdf_core::model::scene::Scene;
use svbrdf_core::progress::Progress;
use svbrdf_core::render::render_f32;
use svbrdf_evaluate::why::{error_maps, mean, worst_first};

use super::{built_in, printed};
use crate::support::tolerance::ERROR_MAP_TEXEL;

/// The largest difference of a map from what is expected.
fn off(map: &Image<f32>, expected: &[[f64; 3]]) -> f64 {
    let pairs = map.pixels.as_flattened().iter().zip(expected.as_flattened());
    pairs.map(|(found, expected)| (f64::from(*found) - expected).abs()).fold(0.0, f64::max)
}

/// The error map by the definition: renderings of whole materials, and logarithms in f64.
fn by_definition(comparison: &Comparison<'_, f32>, scenes: &[Scene]) -> Vec<[f64; 3]> {
    let epsilon = comparison.convention().epsilon;
    let ln = |value: f32| (f64::from(value) + epsilon).ln();
    means(comparison, scenes, |a, b| (ln(a) - ln(b)).abs())
}

/// The mean over scenes of `of` of two renderings of whole materials.
fn means(comparison: &Comparison<'_, f32>, scenes: &[Scene], of: impl Fn(f32, f32) -> f64) -> Vec<[f64; 3]> {
    let render = |material, scene| {
        render_f32(material, scene, comparison.convention(), &Progress::default()).unwrap().pixels
    };
    let (truth, prediction) = (comparison.ground_truth(), comparison.predictions()[0]);
    let mut means = vec![[0.0; 3]; truth.width() * truth.height()];
    for scene in scenes {
        let (expected, predicted) = (render(truth, scene), render(prediction, scene));
        for (mean, (a, b)) in means.iter_mut().zip(expected.iter().zip(&predicted)) {
            (0..3).for_each(|c| mean[c] += of(a[c], b[c]) / scenes.len() as f64);
        }
    }
    means
}

#[test]
fn every_texel_of_the_error_map_is_its_mean_log_difference() {
    let [truth, blurred, rough] = built_in();
    // 101 x 67 texels end in the middle of a block and of a tile; those of a mirror leave the fast path.
    let [truth, blurred, rough] =
        [truth, blurred, rough].map(|material| material.resized([101, 67]).unwrap());
    let mut planes = rough.planes().clone();
    planes.roughness.iter_mut().step_by(7).for_each(|r| *r = 1e-4);
    let mirrors = Material::new("mirrors", 101, 67, planes).unwrap();
    let scenes = Sampling { near: 40, distant: 20, ..Sampling::default() }.scenes(&printed()).unwrap();
    for prediction in [&blurred, &rough, &mirrors] {
        let comparison = Comparison::new(&truth, &[&blurred, prediction], printed()).unwrap();
        let map = error_maps(&comparison, &scenes, &Progress::default()).unwrap().remove(1);
        let comparison = Comparison::new(&truth, &[prediction], printed()).unwrap();
        let expected = by_definition(&comparison, &scenes);
        let off = |map: &Image<f32>| off(map, &expected);
        let off_by = off(&map);
        println!("{}: off by {off_by:e}", prediction.name());
        assert!(off_by < ERROR_MAP_TEXEL, "{}: {off_by:e}", prediction.name());
        let mut faulty = map;
        faulty.pixels.swap(3000, 3001);
        assert!(off(&faulty) > ERROR_MAP_TEXEL, "two swapped texels are not seen");
    }
}

#[test]
fn the_error_map_of_other_renderers_is_theirs() {
    let [truth, _, rough] = built_in();
    let [truth, rough] = [truth, rough].map(|material| material.resized([37, 20]).unwrap());
    for name in ["svbrdf-estimation-2022", "material-palette-2024", "gltf-viewer"] {
        let convention = name.parse().unwrap();
        let comparison = Comparison::new(&truth, &[&rough], convention).unwrap();
        let scenes = Sampling { near: 6, distant: 3, ..Sampling::default() }.scenes(&convention).unwrap();
        let map = error_maps(&comparison, &scenes, &Progress::default()).unwrap().remove(0);
        let expected = by_definition(&comparison, &scenes);
        let off = |map: &Image<f32>| off(map, &expected);
        println!("{name}: off by {:e}", off(&map));
        assert!(off(&map) < ERROR_MAP_TEXEL, "{name}: {:e}", off(&map));
        let other = Comparison::new(&truth, &[&rough], printed()).unwrap();
        let other = error_maps(&other, &scenes, &Progress::default()).unwrap().remove(0);
        assert!(off(&other) > ERROR_MAP_TEXEL, "{name}: another convention is not seen");
    }
}

/// Its mean is the loss of every norm that is a mean over texels; another has no map.
#[test]
fn the_error_map_of_other_norms_is_their_term() {
    let [truth, _, rough] = built_in();
    let [truth, rough] = [truth, rough].map(|material| material.resized([37, 20]).unwrap());
    let matfuse = named::all().iter().find(|one| one.name == "matfuse-2024").unwrap();
    let squared = |a: f32, b: f32| (f64::from(a) - f64::from(b)).powi(2);
    let absolute = |a: f32, b: f32| (f64::from(a) - f64::from(b)).abs();
    for (norm, of, other) in [
        (Norm::Mse, squared as fn(f32, f32) -> f64, absolute as fn(f32, f32) -> f64),
        (Norm::L1, absolute, squared),
    ] {
        let mut described = Description { name: format!("{norm}"), ..matfuse.clone() };
        described.loss.norm = norm;
        let convention = Convention::try_from(&described).unwrap();
        let comparison = Comparison::new(&truth, &[&rough], convention).unwrap();
        let scenes = Sampling { near: 0, distant: 9, ..Sampling::default() }.scenes(&convention).unwrap();
        let map = error_maps(&comparison, &scenes, &Progress::default()).unwrap().remove(0);
        let off = |expected: Vec<[f64; 3]>| {
            let pairs = map.pixels.as_flattened().iter().zip(expected.as_flattened());
            pairs.map(|(a, b)| (f64::from(*a) - b).abs() / b.max(1.0)).fold(0.0, f64::max)
        };
        let [right, wrong] = [of, other].map(|of| off(means(&comparison, &scenes, of)));
        println!("{norm}: off by {right:e}");
        assert!(right < 1e-4 && wrong > 1e-2, "{norm}: {right:e}, the other norm {wrong:e}");
        let loss =
            comparison.run(&Request::Listed(scenes.clone()), &Progress::default()).unwrap().losses.remove(0);
        let ratio = mean(&map) / loss.estimate.mean;
        assert!((ratio - 1.0).abs() < 1e-4, "{norm}: {ratio}");
        described.loss.norm = Norm::Rmse;
        let rmse = Convention::try_from(&described).unwrap();
        let refused =
            error_maps(&Comparison::new(&truth, &[&rough], rmse).unwrap(), &scenes, &Progress::default());
        assert!(matches!(refused, Err(Error::NotComputed { .. })));
    }
}

#[test]
fn the_error_map_is_zero_where_the_texels_are_equal() {
    let [truth, blurred, _] = built_in();
    let mut planes = truth.planes().clone();
    let at = 100 * truth.width() + 30;
    for (plane, other) in planes.normal.iter_mut().zip(&blurred.planes().normal) {
        plane[at] = other[at];
    }
    let one =
        svbrdf_core::material::Material::new("one texel", truth.width(), truth.height(), planes).unwrap();
    let comparison = Comparison::new(&truth, &[&one], printed()).unwrap();
    let scenes = Sampling::default().scenes(&printed()).unwrap();
    let map = error_maps(&comparison, &scenes, &Progress::default()).unwrap().remove(0);
    let wrong = map.pixels.iter().enumerate().filter(|(_, pixel)| **pixel != [0.0; 3]);
    assert_eq!(wrong.map(|(index, _)| index).collect::<Vec<_>>(), [at]);
}

#[test]
fn scenes_are_sorted_worst_first_with_their_losses() {
    let [truth, blurred, rough] = built_in();
    let comparison = Comparison::new(&truth, &[&blurred, &rough], printed()).unwrap();
    let outcome = comparison.run(&Request::Scenes(Sampling::default()), &Progress::default()).unwrap();
    let ranked = worst_first(&outcome);
    let totals: Vec<f64> = ranked.iter().map(|scene| scene.losses.iter().sum()).collect();
    assert!(totals.is_sorted_by(|a, b| a >= b) && totals[0] > totals[8], "{totals:?}");
    let mut indices: Vec<_> = ranked.iter().map(|scene| scene.index).collect();
    indices.sort_unstable();
    assert_eq!(indices, (0..9).collect::<Vec<_>>());
    for scene in &ranked {
        assert_eq!(scene.scene, outcome.scenes[scene.index]);
        let losses: Vec<f64> = outcome.losses.iter().map(|loss| loss.per_scene[scene.index]).collect();
        assert_eq!(scene.losses, losses);
    }
}
