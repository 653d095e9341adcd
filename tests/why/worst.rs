//! The search for the worst scene against brute force, on real materials.

use rand::rngs::ChaCha8Rng;
use rand::{RngExt as _, SeedableRng as _};

use svbrdf_core::loss::Request;
use svbrdf_core::model::convention::PRINTED;
use svbrdf_core::model::scene::Scene;
use svbrdf_core::progress::Progress;
use svbrdf_evaluate::why::{TAIL, worst};

use crate::coverage::measured::{Pair, golden};

/// A scene as a point of the unit cube: 6 numbers of a near-field scene, 4 of a distant one.
#[derive(Clone, Copy)]
struct CubePoint {
    is_near: bool,
    at: [f64; 6],
}

impl CubePoint {
    fn random(generator: &mut ChaCha8Rng, is_near: bool) -> Self {
        Self { is_near, at: [(); 6].map(|()| generator.random::<f64>()) }.inside()
    }

    /// Moved by up to `reach` in each number.
    fn near(self, generator: &mut ChaCha8Rng, reach: f64) -> Self {
        Self { at: self.at.map(|x| x + reach * (2.0 * generator.random::<f64>() - 1.0)), ..self }.inside()
    }

    /// Within the cube, and distances within the central 99%.
    fn inside(self) -> Self {
        let bound = |(i, x): (usize, f64)| {
            let [low, high] = if i < 4 { [1e-9, 1.0 - 1e-9] } else { [TAIL, 1.0 - TAIL] };
            if (low..=high).contains(&x) { x } else { low + (x - low).rem_euclid(high - low) }
        };
        let mut at = self.at;
        at.iter_mut().enumerate().for_each(|(i, x)| *x = bound((i, *x)));
        Self { at, ..self }
    }

    fn scene(&self) -> Scene {
        let [a, b, c, d, ..] = self.at;
        if self.is_near {
            Scene::near_from_point(self.at, &PRINTED)
        } else {
            Scene::distant_from_point([a, b, c, d], &PRINTED)
        }
    }
}

fn losses(pair: &Pair, points: &[CubePoint]) -> Vec<f64> {
    let request = Request::Listed(points.iter().map(CubePoint::scene).collect());
    let outcome = pair.comparison().without_pilot().run(&request, &Progress::default()).unwrap();
    outcome.losses[0].per_scene.clone()
}

/// The largest loss of `near` + `distant` random scenes, the worst 20 of which climb at random.
fn brute_force(pair: &Pair, [near, distant]: [usize; 2], climbs: i32) -> f64 {
    let mut generator = ChaCha8Rng::seed_from_u64(4711);
    let kinds = std::iter::repeat_n(true, near).chain(std::iter::repeat_n(false, distant));
    let points: Vec<CubePoint> = kinds.map(|is_near| CubePoint::random(&mut generator, is_near)).collect();
    let mut best: Vec<(CubePoint, f64)> = Vec::new();
    for some in points.chunks(4096) {
        best.extend(some.iter().copied().zip(losses(pair, some)));
        best.sort_by(|a, b| b.1.total_cmp(&a.1));
        best.truncate(20);
    }
    for climb in 0..climbs {
        let reach = 0.1 * 0.97_f64.powi(climb);
        let around = |(point, _): &(CubePoint, f64)| [(); 8].map(|()| point.near(&mut generator, reach));
        let tried: Vec<CubePoint> = best.iter().flat_map(around).collect();
        let found = losses(pair, &tried);
        for (best, (points, losses)) in best.iter_mut().zip(tried.chunks(8).zip(found.chunks(8))) {
            for (point, loss) in points.iter().zip(losses) {
                if *loss > best.1 {
                    *best = (*point, *loss);
                }
            }
        }
    }
    best.iter().map(|(_, loss)| *loss).fold(0.0, f64::max)
}

#[test]
#[ignore = "takes minutes; docs/verification.md has its command"]
fn the_worst_scene_of_real_materials_is_within_1_percent_of_brute_force() {
    let pairs = golden(32, 4);
    let ratio = |pair: &Pair| {
        let [truth, prediction] = [&pair.ground_truth, &pair.prediction];
        let found = worst(truth, prediction, &PRINTED, 0, TAIL, &Progress::default()).unwrap();
        let ratio = found.loss / brute_force(pair, [133_333, 66_667], 200);
        println!("{}: {:.4}, {ratio:.4} times that of brute force", pair.name(), found.loss);
        ratio
    };
    let ratios: Vec<f64> = pairs.iter().take(10).map(ratio).collect();
    assert_eq!(ratios.len(), 10, "the reference materials beside the checkout");
    assert!(ratios.iter().all(|ratio| *ratio > 0.99), "{ratios:.4?}");
}
