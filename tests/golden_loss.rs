//! Losses, renderings and single texels against numbers that were computed independently of this project.

use std::fs;
use std::path::{Path, PathBuf};

use serde_json::Value;

use svbrdf_core::loss::{Compute, Plain};
use svbrdf_core::material::Material;
use svbrdf_core::math::real::Real;
use svbrdf_core::model::convention::{ALL, Convention, PRINTED};
use svbrdf_core::model::scene::Scene;
use svbrdf_core::progress::Progress;
use svbrdf_core::render::render;
use svbrdf_files::read::{ReadOptions, read};
use svbrdf_needs::needs;

use crate::support::losses::losses;
use crate::support::tolerance::{GOLDEN_LOSS_F32, GOLDEN_LOSS_F64, GOLDEN_PROBE_F32, GOLDEN_PROBE_F64};

/// The worst relative errors: of losses and mean renderings, and of single texels; and how many texels were compared.
struct Worst {
    loss: f64,
    probe: f64,
    texels: usize,
}

/// What was computed independently from a case in a convention.
pub struct Expected {
    pub loss: f64,
    pub per_scene: Vec<f64>,
}

/// Golden cases that there must be.
const CASES: usize = 7;

/// Texels that must be compared.
const TEXELS: usize = 210;

#[needs(shared)]
#[test]
fn losses_and_renderings_are_the_golden_ones_in_both_precisions() {
    for (worst, loss, probe) in [
        (check_all::<f64>(), GOLDEN_LOSS_F64, GOLDEN_PROBE_F64),
        (check_all::<f32>(), GOLDEN_LOSS_F32, GOLDEN_PROBE_F32),
    ] {
        assert!(worst.loss <= loss, "loss off by {:e}, at most {loss:e}", worst.loss);
        assert!(worst.probe <= probe, "texel off by {:e}, at most {probe:e}", worst.probe);
    }
}

#[test]
fn a_wrong_loss_is_seen() {
    assert!(relative_error(1.0 + 2e-9, 1.0) > GOLDEN_LOSS_F64);
    assert!(relative_error(1.0 + 5e-5, 1.0) > GOLDEN_LOSS_F32);
    assert!(relative_error(f64::NAN, 1.0).is_infinite());
    assert!(relative_error(1e-300, 0.0).is_infinite());
}

fn golden() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/golden")
}

/// Every golden case: two materials, scenes, and what was computed from them.
pub fn cases() -> Vec<Value> {
    cases_of(&golden().join("loss")).unwrap_or_else(|e| panic!("{e}"))
}

fn cases_of(folder: &Path) -> Result<Vec<Value>, String> {
    let files = fs::read_dir(folder).unwrap();
    let read = |file: fs::DirEntry| fs::read_to_string(file.path()).unwrap();
    let cases: Vec<Value> = files.map(|file| serde_json::from_str(&read(file.unwrap())).unwrap()).collect();
    if cases.len() < CASES {
        return Err(format!("{} golden cases, not {CASES}, are in {}", cases.len(), folder.display()));
    }
    Ok(cases)
}

/// The golden numbers of `case` in `convention`.
pub fn expected(case: &Value, convention: &Convention) -> Result<Expected, String> {
    let numbers = &case["expected"][convention.name];
    let list = |key: &str| numbers[key].as_array()?.iter().map(Value::as_f64).collect::<Option<Vec<f64>>>();
    let read = numbers["loss"].as_f64().zip(list("per_scene"));
    match (read, case["scenes"].as_array()) {
        (Some((loss, per_scene)), Some(scenes)) if !scenes.is_empty() && per_scene.len() == scenes.len() => {
            Ok(Expected { loss, per_scene })
        }
        _ => Err(format!("{} lacks a number in {}", case["id"], convention.name)),
    }
}

#[test]
fn an_empty_folder_and_a_case_without_numbers_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    assert!(cases_of(folder.path()).is_err());
    let scenes = serde_json::json!([0, 0]);
    let case =
        |expected: Value| serde_json::json!({ "id": "planted", "scenes": scenes, "expected": expected });
    let printed = |per_scene: &[f64]| {
        let of = serde_json::json!({ PRINTED.name: { "loss": 1.0, "per_scene": per_scene } });
        expected(&case(of), &PRINTED).map(|expected| expected.per_scene.len())
    };
    assert_eq!(printed(&[1.0, 2.0]), Ok(2));
    assert!(printed(&[1.0]).is_err() && printed(&[]).is_err());
    assert!(expected(&case(serde_json::json!({})), &PRINTED).is_err());
}

fn check_all<T: Compute>() -> Worst {
    let mut worst = Worst { loss: 0.0, probe: 0.0, texels: 0 };
    for case in cases() {
        check_case::<T>(&case, &mut worst);
    }
    println!("{}: worst loss {:e}, worst of {} texels {:e}", T::NAME, worst.loss, worst.texels, worst.probe);
    assert!(worst.texels >= TEXELS, "only {} texels were compared", worst.texels);
    worst
}

fn check_case<T: Compute>(case: &Value, worst: &mut Worst) {
    let materials = ["ground_truth", "prediction"].map(|key| material::<T>(&case[key]));
    let scenes: Vec<Scene> = serde_json::from_value(case["scenes"].clone()).unwrap();
    for convention in ALL {
        let golden = expected(case, &convention).unwrap_or_else(|e| panic!("{e}"));
        let means = &case["expected"][convention.name];
        let [ground_truth, prediction] = &materials;
        let loss = &losses(&Plain, ground_truth, &[prediction], &scenes, &convention).unwrap()[0];
        let mut compare = |got: f64, want: f64| worst.loss = worst.loss.max(relative_error(got, want));
        compare(loss.estimate.mean, golden.loss);
        for (i, scene) in scenes.iter().enumerate() {
            compare(loss.per_scene[i], golden.per_scene[i]);
            for (material, key) in
                [(ground_truth, "mean_rendering_ground_truth"), (prediction, "mean_rendering_prediction")]
            {
                compare(mean_rendering(material, scene, &convention), means[key][i].as_f64().unwrap());
            }
        }
        for probe in case["probes"].as_array().unwrap() {
            let which = usize::from(probe["material"] == "prediction");
            let scene = &scenes[probe["scene"].as_u64().unwrap() as usize];
            let (probe, texels) = worst_probe(&materials[which], scene, &convention, probe);
            worst.probe = worst.probe.max(probe);
            worst.texels += texels;
        }
    }
}

/// The material that a golden case describes.
pub fn material<T: Real>(described: &Value) -> Material<T> {
    let path = golden().join(described["file"].as_str().unwrap());
    let albedo = described["albedo"].as_str().unwrap().parse().unwrap();
    let options = ReadOptions { albedo: Some(albedo), ..ReadOptions::default() };
    read(&path, &options, &Progress::default()).unwrap().material
}

fn mean_rendering<T: Real>(material: &Material<T>, scene: &Scene, convention: &Convention) -> f64 {
    let image = render(material, scene, convention, &Progress::default()).unwrap();
    let sum: f64 = image.pixels.iter().flatten().map(|x| x.f64()).sum();
    sum / (3.0 * image.pixels.len() as f64)
}

/// The worst relative error of the texels of `probe` that were computed in `convention`, and their number.
fn worst_probe<T: Real>(
    material: &Material<T>,
    scene: &Scene,
    convention: &Convention,
    probe: &Value,
) -> (f64, usize) {
    let image = render(material, scene, convention, &Progress::default()).unwrap();
    let (mut worst, mut texels) = (0.0_f64, 0);
    for pixel in probe["pixels"].as_array().unwrap() {
        let Some(expected) = pixel.get(convention.name) else { continue };
        texels += 1;
        let [row, column] = ["row", "col"].map(|key| pixel[key].as_u64().unwrap() as usize);
        for (channel, got) in image.pixels[row * image.width + column].into_iter().enumerate() {
            worst = worst.max(relative_error(got.f64(), expected[channel].as_f64().unwrap()));
        }
    }
    (worst, texels)
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
