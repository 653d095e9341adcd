//! The search for the worst scene against brute force.

use rand::rngs::ChaCha8Rng;
use rand::{RngExt as _, SeedableRng as _};

use super::worst::{TAIL, worst};
use crate::diagnose::tests::materials::{generated, unexplained, with};
use svbrdf_core::loss::{Comparison, Compute as _};
use svbrdf_core::material::Material;
use svbrdf_core::model::convention::PRINTED;
use svbrdf_core::model::sampler::Sampler;
use svbrdf_core::model::scene::{Kind, Scene};
use svbrdf_core::progress::Progress;

const SIDE: usize = 32;

/// The largest loss of `near` + `distant` random scenes, the worst 20 of which climb at random.
fn brute_force(
    truth: &Material<f32>,
    prediction: &Material<f32>,
    [near, distant]: [usize; 2],
    climbs: usize,
) -> f64 {
    let comparison = Comparison::new(truth, &[prediction], PRINTED).unwrap();
    let losses = |scenes: &[Scene]| {
        f32::cpu().scene_losses(&comparison, scenes, None, &Progress::default()).unwrap().remove(0)
    };
    let scenes = Sampler::Random.scenes(4711, near, distant, &PRINTED);
    let mut ranked: Vec<(Scene, f64)> =
        scenes.iter().copied().zip(losses(&scenes)).filter(|(scene, _)| is_central(scene)).collect();
    ranked.sort_by(|a, b| b.1.total_cmp(&a.1));
    ranked.truncate(20);
    let mut generator = ChaCha8Rng::seed_from_u64(1);
    for climb in 0..climbs {
        let reach = 0.2 * 0.98_f64.powi(climb as i32);
        let mut around = |scene: &Scene| {
            let mut moved = |p: [f64; 3]| p.map(|x| x + reach * (2.0 * generator.random::<f64>() - 1.0));
            Scene { view: moved(scene.view), light: moved(scene.light), ..*scene }
        };
        let tried: Vec<Scene> =
            ranked.iter().flat_map(|(scene, _)| (0..8).map(|_| around(scene)).collect::<Vec<_>>()).collect();
        let tried: Vec<Scene> = tried
            .into_iter()
            .zip(ranked.iter().flat_map(|(scene, _)| [*scene; 8]))
            .map(|(new, old)| if is_sampled(&new) { new } else { old })
            .collect();
        let found = losses(&tried);
        for (best, (scenes, losses)) in ranked.iter_mut().zip(tried.chunks(8).zip(found.chunks(8))) {
            for (scene, loss) in scenes.iter().zip(losses) {
                if *loss > best.1 {
                    *best = (*scene, *loss);
                }
            }
        }
    }
    ranked.iter().map(|(_, loss)| *loss).fold(0.0, f64::max)
}

/// Whether a distant scene has directions that Algorithm 2 samples. Near-field scenes have six numbers of which free positions keep
/// nothing, so these do not climb.
fn is_sampled(scene: &Scene) -> bool {
    let least = (1.0 - PRINTED.u1_max).sqrt();
    let is_high = |[x, y, z]: [f64; 3]| z > 0.0 && z / (x * x + y * y + z * z).sqrt() >= least;
    scene.kind == Kind::Distant && is_high(scene.view) && is_high(scene.light)
}

/// Whether the distances of a near-field scene are within the central 99%.
fn is_central(scene: &Scene) -> bool {
    if scene.kind == Kind::Distant {
        return true;
    }
    // The view and the light are opposite of a point of the plane, in proportion to their distances and heights.
    let share = scene.view[2] / (scene.view[2] + scene.light[2]);
    let foot: Vec<f64> = (0..2).map(|i| scene.view[i] + share * (scene.light[i] - scene.view[i])).collect();
    let distance = |p: [f64; 3]| ((p[0] - foot[0]).powi(2) + (p[1] - foot[1]).powi(2) + p[2].powi(2)).sqrt();
    let is_central = |p, sigma: f64| (distance(p).ln() - 0.5).abs() <= 2.5758 * sigma;
    is_central(scene.view, 0.75) && is_central(scene.light, PRINTED.light_distance_sigma)
}

fn pair(seed: u64) -> [Material<f32>; 2] {
    let truth = generated(seed, SIDE);
    let prediction = if seed.is_multiple_of(2) {
        unexplained(&truth, seed / 2)
    } else {
        with(&truth, |planes| planes.roughness.iter_mut().for_each(|r| *r = (*r * 1.3).min(1.0)))
    };
    [truth, prediction]
}

fn ratio(seed: u64, scenes: [usize; 2], climbs: usize) -> f64 {
    let [truth, prediction] = pair(seed);
    let found = worst(&truth, &prediction, &PRINTED, 0, TAIL, &Progress::default()).unwrap();
    found.loss / brute_force(&truth, &prediction, scenes, climbs)
}

#[test]
fn the_search_is_at_least_as_good_as_some_brute_force() {
    for seed in 0..4 {
        let ratio = ratio(seed, [6000, 3000], 50);
        assert!(ratio > 0.99, "pair {seed}: {ratio}");
    }
}

/// The largest loss of 7,200 distant scenes with light and view as low as they are sampled, in mirror directions of each other.
fn worst_grazing(truth: &Material<f32>, prediction: &Material<f32>) -> f64 {
    let scene = |i: usize| {
        let azimuth = i as f64 / 7200.0;
        Scene::distant_from_point([1.0, azimuth, 1.0, (azimuth + 0.5).rem_euclid(1.0)], &PRINTED)
    };
    let comparison = Comparison::new(truth, &[prediction], PRINTED).unwrap();
    let scenes: Vec<Scene> = (0..7200).map(scene).collect();
    let losses = f32::cpu().scene_losses(&comparison, &scenes, None, &Progress::default()).unwrap().remove(0);
    losses.into_iter().fold(0.0, f64::max)
}

/// Highlights of smooth materials are narrower there than the gaps between sampled scenes.
#[test]
fn the_search_finds_narrow_highlights_at_grazing_angles() {
    let smooth =
        |seed| with(&generated(seed, SIDE), |planes| planes.roughness.iter_mut().for_each(|r| *r *= 0.4));
    for [truth, prediction] in [[0, 6], [3, 6], [0, 8], [1, 8], [3, 8], [5, 10]] {
        let (truth, prediction) = (smooth(truth), smooth(prediction));
        let found = worst(&truth, &prediction, &PRINTED, 0, TAIL, &Progress::default()).unwrap();
        let ratio = found.loss / worst_grazing(&truth, &prediction);
        assert!(ratio > 0.99, "{}: {ratio}", truth.name());
    }
}

#[test]
#[ignore = "takes minutes; docs/verification.md has its command and its result"]
fn the_search_is_within_1_percent_of_200_000_scenes() {
    let ratios: Vec<f64> = (0..20).map(|seed| ratio(seed, [133_333, 66_667], 200)).collect();
    println!("found / brute force: {ratios:.4?}");
    assert!(ratios.iter().all(|ratio| *ratio > 0.99), "{ratios:?}");
}
