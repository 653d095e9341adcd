//! Losses, renderings and single texels against numbers that were computed independently of this project.

use std::fs;
use std::path::{Path, PathBuf};

use serde_json::Value;

use svbrdf_core::loss::{Backend, Compute, Plain};
use svbrdf_core::material::Material;
use svbrdf_core::math::real::Real;
use svbrdf_core::model::convention::{ALL, Convention};
use svbrdf_core::model::scene::Scene;
use svbrdf_core::progress::Progress;
use svbrdf_core::render::render;
use svbrdf_files::read::{ReadOptions, read};
use svbrdf_needs::needs;

use super::losses::{compare, rungs};
use crate::support::losses::losses;
use crate::support::tolerance::{GOLDEN_F32, GOLDEN_F64, LOSS_RANDOM};

/// Golden cases, and texels of them in a precision, that there must be.
const CASES: usize = 7;
const TEXELS: usize = 210;

fn golden() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/golden")
}

/// Every golden case: two materials, scenes, and what was computed from them.
fn cases() -> Vec<Value> {
    let files = fs::read_dir(golden().join("loss")).unwrap();
    let read = |file: fs::DirEntry| fs::read_to_string(file.path()).unwrap();
    let cases: Vec<Value> = files.map(|file| serde_json::from_str(&read(file.unwrap())).unwrap()).collect();
    assert!(cases.len() >= CASES, "{} golden cases", cases.len());
    cases
}

fn scenes(case: &Value) -> Vec<Scene> {
    serde_json::from_value(case["scenes"].clone()).unwrap()
}

fn numbers(list: &Value) -> Vec<f64> {
    list.as_array().unwrap().iter().map(|number| number.as_f64().unwrap()).collect()
}

/// The ground truth and the prediction of a case.
fn materials<T: Real>(case: &Value) -> [Material<T>; 2] {
    ["ground_truth", "prediction"].map(|key| {
        let albedo = Some(case[key]["albedo"].as_str().unwrap().parse().unwrap());
        let path = golden().join(case[key]["file"].as_str().unwrap());
        read(&path, &ReadOptions { albedo, ..ReadOptions::default() }, &Progress::default()).unwrap().material
    })
}

/// |got - expected| / |expected|; infinite where `got` is NaN, or not 0 though 0 is expected.
fn relative_error(got: f64, expected: f64) -> f64 {
    let error = (got - expected).abs();
    if error == 0.0 {
        0.0
    } else if error.is_nan() || expected == 0.0 {
        f64::INFINITY
    } else {
        error / expected.abs()
    }
}

/// The worst relative error of losses, mean renderings and single texels, computed by `rung`; and how many
/// texels were compared.
fn worst<T: Compute>(rung: &dyn Backend<T>) -> (f64, usize) {
    let (mut worst, mut texels) = (0.0_f64, 0);
    let mut compare = |got: f64, want: f64| worst = worst.max(relative_error(got, want));
    for case in cases() {
        let (materials, scenes) = (materials::<T>(&case), scenes(&case));
        for convention in ALL {
            let expected = &case["expected"][convention.name];
            let loss = &losses(rung, &materials[0], &[&materials[1]], &scenes, &convention).unwrap()[0];
            compare(loss.estimate.mean, expected["loss"].as_f64().unwrap());
            let per_scene = numbers(&expected["per_scene"]);
            assert!(!scenes.is_empty() && per_scene.len() == scenes.len());
            loss.per_scene.iter().zip(per_scene).for_each(|(got, want)| compare(*got, want));
            let images = materials.each_ref().map(|material| {
                let image = |scene| render(material, scene, &convention, &Progress::default()).unwrap();
                scenes.iter().map(image).collect::<Vec<_>>()
            });
            for (images, key) in
                images.iter().zip(["mean_rendering_ground_truth", "mean_rendering_prediction"])
            {
                for (image, want) in images.iter().zip(numbers(&expected[key])) {
                    let values: Vec<f64> = image.pixels.iter().flatten().map(|value| value.f64()).collect();
                    compare(values.iter().sum::<f64>() / values.len() as f64, want);
                }
            }
            for probe in case["probes"].as_array().unwrap() {
                let images = &images[usize::from(probe["material"] == "prediction")];
                let image = &images[probe["scene"].as_u64().unwrap() as usize];
                for pixel in probe["pixels"].as_array().unwrap() {
                    let Some(expected) = pixel.get(convention.name) else { continue };
                    texels += 1;
                    let [row, column] = ["row", "col"].map(|key| pixel[key].as_u64().unwrap() as usize);
                    let got = image.pixels[row * image.width + column];
                    got.into_iter().zip(numbers(expected)).for_each(|(got, want)| compare(got.f64(), want));
                }
            }
        }
    }
    (worst, texels)
}

#[needs(shared)]
fn losses_and_renderings_are_the_golden_ones_in_both_precisions() {
    let (in_f64, in_f32) = (worst::<f64>(&Plain), worst::<f32>(&Plain));
    println!("worst errors {:e} in f64, {:e} in f32", in_f64.0, in_f32.0);
    assert!(in_f64.0 <= GOLDEN_F64 && in_f32.0 <= GOLDEN_F32, "{in_f64:?} {in_f32:?}");
    assert!(in_f64.1 >= TEXELS && in_f32.1 >= TEXELS);
    // Planted faults.
    assert!(relative_error(1.0 + 2e-9, 1.0) > GOLDEN_F64 && relative_error(1.0 + 5e-5, 1.0) > GOLDEN_F32);
    assert!(relative_error(f64::NAN, 1.0).is_infinite() && relative_error(1e-300, 0.0).is_infinite());
}

#[needs(shared)]
fn losses_are_the_golden_ones_on_every_rung() {
    for (case, convention) in cases().iter().flat_map(|case| ALL.map(|convention| (case, convention))) {
        let ([gt, prediction], scenes): (_, Vec<Scene>) = (materials::<f32>(case), scenes(case));
        let want = numbers(&case["expected"][convention.name]["per_scene"]);
        for (name, rung) in rungs().iter().filter(|(name, _)| *name != "f32") {
            let of = |c: &Convention| {
                losses(&**rung, &gt, &[&prediction], &scenes, c).unwrap().remove(0).per_scene
            };
            let [mean, scene] = compare(&of(&convention), &want, LOSS_RANDOM).expect(name);
            println!("{}, {}, {name}: loss {mean:.1e}, scene {scene:.1e}", case["id"], convention.name);
        }
    }
}
