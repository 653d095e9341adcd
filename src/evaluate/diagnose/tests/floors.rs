//! The floor.

use super::super::{Storage, floor};
use super::materials::{generated, with};
use svbrdf_core::loss::{Comparison, Request, Sampling};
use svbrdf_core::material::Material;
use svbrdf_core::model::convention::PRINTED;
use svbrdf_core::model::sampler::Sampler;
use svbrdf_core::progress::Progress;
use svbrdf_files::read::Albedo;

#[test]
fn the_floor_is_the_loss_of_brute_force_dithering() {
    let truth = generated(0, 32);
    let storage =
        Storage { colours: Some(Albedo::Srgb), specular: Some(Albedo::Linear), ..Storage::default() };
    let floor = floor(&truth, &storage, &PRINTED, 3, &Progress::default()).unwrap();
    // Written down once more, with a plain generator and 16 other copies.
    let mut state = 1_u64;
    let mut uniform = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        ((state >> 40) as f64 / (1u64 << 24) as f64 - 0.5) / 255.0
    };
    let copies: Vec<Material<f32>> = (0..16)
        .map(|_| {
            with(&truth, |planes| {
                planes.normal.iter_mut().flatten().for_each(|n| *n += (2.0 * uniform()) as f32);
                for d in planes.diffuse.iter_mut().flatten() {
                    let stored = svbrdf_core::math::srgb::encode(f64::from(*d)) + uniform();
                    *d = svbrdf_core::math::srgb::decode(stored.clamp(0.0, 1.0)) as f32;
                }
                let rest = planes.specular.iter_mut().flatten().chain(&mut planes.roughness);
                rest.for_each(|x| *x = (f64::from(*x) + uniform()).clamp(0.0, 1.0) as f32);
            })
        })
        .collect();
    let copies: Vec<&Material<f32>> = copies.iter().collect();
    let sampling =
        Sampling { near: 128, distant: 64, seed: 3, sampler: Sampler::Sobol, ..Sampling::default() };
    let comparison = Comparison::new(&truth, &copies, PRINTED).unwrap();
    let outcome = comparison.run(&Request::Scenes(sampling), &Progress::default()).unwrap();
    let mean = outcome.losses.iter().map(|loss| loss.estimate.mean).sum::<f64>() / 16.0;
    assert!((floor.mean / mean - 1.0).abs() < 0.02, "{} {mean}", floor.mean);
    let floats = Storage { steps: [0.0; 4], ..storage.clone() };
    let none = super::super::floor(&truth, &floats, &PRINTED, 3, &Progress::default()).unwrap();
    assert!(none.mean < 1e-5, "{none:?}");
    let coarse = Storage { steps: [2.0 / 255.0; 4], ..storage };
    let coarse = super::super::floor(&truth, &coarse, &PRINTED, 3, &Progress::default()).unwrap();
    assert!(coarse.mean > 1.5 * floor.mean, "a planted fault: {coarse:?}");
}
