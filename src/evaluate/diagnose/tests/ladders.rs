//! The ladder, the filtered roughness and the floor.

use rand::SeedableRng as _;
use rand::rngs::ChaCha8Rng;

use super::super::{Storage, StoredEncoding, filtered_roughness, floor, floor_of_captures, ladder};
use super::materials::{field, generated, with};
use crate::error::Error;
use svbrdf_core::error::Error as CoreError;
use svbrdf_core::loss::{Comparison, Request, Sampling};
use svbrdf_core::material::{Material, Planes};
use svbrdf_core::model::convention::PRINTED;
use svbrdf_core::model::sampler::Sampler;
use svbrdf_core::progress::Progress;

/// Bumps of height `amplitude * sin(2 pi x / period) * sin(2 pi y / period)`, and uniform roughness.
fn bumps(side: usize, period: f64, amplitude: f64, roughness: f32) -> Material<f32> {
    let k = std::f64::consts::TAU / period;
    let slope = |index: usize| {
        let (x, y) = ((index % side) as f64, (index / side) as f64);
        [amplitude * k * (k * x).cos() * (k * y).sin(), amplitude * k * (k * x).sin() * (k * y).cos()]
    };
    let component = |axis: usize| (0..side * side).map(|index| -slope(index)[axis] as f32).collect();
    let plane = |value: f32| vec![value; side * side];
    let planes = Planes {
        normal: [component(0), component(1), plane(1.0)],
        diffuse: [plane(0.3), plane(0.3), plane(0.3)],
        specular: [plane(0.04), plane(0.04), plane(0.04)],
        roughness: plane(roughness),
    };
    Material::new("bumps", side, side, planes).unwrap()
}

#[test]
fn the_filtered_roughness_of_sine_bumps_is_that_of_the_closed_form() {
    let (period, amplitude, roughness) = (16.0, 0.7, 0.3_f32);
    let material = bumps(64, period, amplitude, roughness);
    // Each slope has the variance (a k)^2 / 4 over whole periods, and the mean 0.
    let k = std::f64::consts::TAU / period;
    let alpha2 = f64::from(roughness).powi(4);
    let expected = (alpha2 + 2.0 * (amplitude * k).powi(2) / 4.0).powf(0.25);
    for level in [4, 5, 6] {
        let found = filtered_roughness(&material)[level];
        assert!((found - expected).abs() < 1e-6, "{level}: {found} {expected}");
    }
    assert!((filtered_roughness(&material)[0] - f64::from(roughness)).abs() < 1e-7);
    assert_eq!(filtered_roughness(&material).len(), 7);
    let planted = bumps(64, period, 1.02 * amplitude, roughness);
    assert!((filtered_roughness(&planted)[4] - expected).abs() > 1e-3, "a planted fault");
}

/// On diffuse stripes the mean radiance of a block is that of the mean diffuse: a misplaced stripe is gone at the second rung.
#[test]
fn the_ladder_of_misplaced_stripes_has_the_closed_form_and_a_darker_material_keeps_its_loss() {
    let stripes = |low: f32, high: f32, odd: usize| {
        let plane = |constant: f32| vec![constant; 256];
        let diffuse: Vec<f32> = (0..256).map(|i| if i % 2 == odd { high } else { low }).collect();
        let planes = Planes {
            normal: [plane(0.0), plane(0.0), plane(1.0)],
            diffuse: [diffuse.clone(), diffuse.clone(), diffuse],
            specular: [plane(1.0), plane(1.0), plane(1.0)].map(|s| s.iter().map(|_| 0.0).collect()),
            roughness: plane(1.0),
        };
        Material::new("stripes", 16, 16, planes).unwrap()
    };
    let scenes = Sampler::Random.scenes(0, 0, 6, &PRINTED);
    let rungs = |prediction: &Material<f32>| {
        let rungs =
            ladder(&stripes(0.1, 0.6, 0), prediction, &scenes, &PRINTED, &Progress::default()).unwrap();
        rungs.iter().map(|rung| rung.loss).collect::<Vec<_>>()
    };
    let misplaced = rungs(&stripes(0.1, 0.6, 1));
    assert!(misplaced.len() == 5 && misplaced[0] > 0.5, "{misplaced:?}");
    assert!(misplaced[1..].iter().all(|loss| *loss < 1e-6), "{misplaced:?}");
    let darker = rungs(&stripes(0.05, 0.3, 0));
    assert!(darker.iter().all(|loss| (loss / darker[1] - 1.0).abs() < 0.1), "{darker:?}");
    // The first rung is the loss.
    let (truth, other) = (stripes(0.1, 0.6, 0), stripes(0.05, 0.3, 0));
    let request = Request::Listed(scenes.clone());
    let comparison = Comparison::new(&truth, &[&other], PRINTED).unwrap();
    let loss = comparison.run(&request, &Progress::default()).unwrap().losses[0].estimate.mean;
    assert!((darker[0] / loss - 1.0).abs() < 1e-5, "{darker:?} {loss}");
}

#[test]
fn the_floor_is_the_loss_of_brute_force_dithering() {
    let truth = generated(0, 32);
    let storage =
        Storage { colours: StoredEncoding::Srgb, specular: StoredEncoding::Linear, ..Storage::default() };
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

#[test]
fn the_floor_of_captures_is_the_mean_loss_of_all_pairs() {
    let truth = generated(0, 16);
    let darker =
        |factor: f32| with(&truth, |planes| planes.diffuse.iter_mut().flatten().for_each(|d| *d *= factor));
    let captures = [truth.clone(), darker(0.9), darker(0.7)];
    let loss = |first: usize, second: usize| {
        let sampling =
            Sampling { near: 128, distant: 64, seed: 5, sampler: Sampler::Sobol, ..Sampling::default() };
        let comparison = Comparison::new(&captures[first], &[&captures[second]], PRINTED).unwrap();
        let outcome = comparison.run(&Request::Scenes(sampling), &Progress::default()).unwrap();
        outcome.losses[0].estimate.mean
    };
    let pairs = [loss(0, 1), loss(0, 2), loss(1, 2)];
    let floor =
        |repeats: &[Material<f32>]| floor_of_captures(&truth, repeats, &PRINTED, 5, &Progress::default());
    let found = floor(&captures[1..]).unwrap().mean;
    assert!((found / (pairs.iter().sum::<f64>() / 3.0) - 1.0).abs() < 1e-6, "{found} {pairs:?}");
    assert!((found / pairs[0] - 1.0).abs() > 0.1, "a planted fault");
    assert!(matches!(floor(&[]), Err(Error::NoPrediction)));
    let refused = floor(&[generated(0, 8)]).unwrap_err();
    assert!(matches!(refused.core(), Some(CoreError::SizesDiffer { .. })), "{refused}");
}

#[test]
fn generated_fields_vary() {
    let values = field(&mut ChaCha8Rng::seed_from_u64(1), 32, 1.0);
    assert!(values.iter().any(|x| *x < 0.3) && values.iter().any(|x| *x > 0.7));
}
