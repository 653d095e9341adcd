//! The loss over texels, and over scenes.

use svbrdf::image::Image;
use svbrdf::loss::{Comparison, Request, Sampling};
use svbrdf::progress::Progress;
use svbrdf::why::{error_maps, mean, worst_first};

use super::{built_in, printed};
use crate::support::tolerance::ERROR_MAP_MEAN;

#[test]
fn the_mean_of_the_error_map_is_the_loss() {
    let [truth, blurred, rough] = built_in();
    let comparison = Comparison::new(&truth, &[&blurred, &rough], printed()).unwrap();
    let outcome = comparison.run(&Request::Scenes(Sampling::default()), &Progress::default()).unwrap();
    let maps = error_maps(&comparison, &outcome.scenes, &Progress::default()).unwrap();
    let off = |map: &Image<f32>, loss: f64| (mean(map) / loss - 1.0).abs();
    for (map, loss) in maps.iter().zip(&outcome.losses) {
        let off = off(map, loss.estimate.mean);
        assert!(off < ERROR_MAP_MEAN, "{}: {off:e}", loss.prediction);
    }
    let mut faulty = maps[0].clone();
    faulty.pixels[77][1] += 10.0;
    assert!(off(&faulty, outcome.losses[0].estimate.mean) > ERROR_MAP_MEAN, "one wrong texel is not seen");
}

#[test]
fn the_error_map_is_zero_where_the_texels_are_equal() {
    let [truth, blurred, _] = built_in();
    let mut planes = truth.planes().clone();
    let at = 100 * truth.width() + 30;
    for (plane, other) in planes.normal.iter_mut().zip(&blurred.planes().normal) {
        plane[at] = other[at];
    }
    let one = svbrdf::material::Material::new("one texel", truth.width(), truth.height(), planes).unwrap();
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
