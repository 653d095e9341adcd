//! Files of public repositories, read as their formats specify: `../shared/real`, decoded independently of this project.

use std::fs;
use std::path::{Path, PathBuf};

use serde_json::Value;
use svbrdf_core::material::Material;
use svbrdf_core::progress::Progress;
use svbrdf_files::read::{ReadOptions, read};

fn real() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/real")
}

/// Within 4e-3 or 2.5%, whichever is larger, as the README of the files has it.
fn is_near(value: f64, expected: f64) -> bool {
    (value - expected).abs() <= f64::max(4e-3, 0.025 * expected.abs())
}

/// The means of normal, diffuse, specular and roughness.
fn means(material: &Material<f32>) -> [Vec<f64>; 4] {
    let mean = |plane: &Vec<f32>| plane.iter().map(|v| f64::from(*v)).sum::<f64>() / plane.len() as f64;
    let planes = material.planes();
    let three = |planes: &[Vec<f32>; 3]| planes.iter().map(mean).collect::<Vec<_>>();
    [three(&planes.normal), three(&planes.diffuse), three(&planes.specular), vec![mean(&planes.roughness)]]
}

/// What differs between a material and the expected means; nothing where it is read right.
fn differences(case: &Value, material: &Material<f32>) -> Vec<String> {
    let mut all = Vec::new();
    let size: Vec<u64> = material.size().iter().map(|side| *side as u64).collect();
    // A constant material may be read in any size.
    if case["size"] != serde_json::json!([1, 1]) && case["size"] != serde_json::json!(size) {
        all.push(format!("size {size:?} for {}", case["size"]));
    }
    for (map, got) in ["normal", "diffuse", "specular", "roughness"].into_iter().zip(means(material)) {
        let expected: Vec<f64> = match &case[map] {
            Value::Array(all) => all.iter().filter_map(Value::as_f64).collect(),
            one => one.as_f64().into_iter().collect(),
        };
        assert_eq!(expected.len(), got.len(), "{map}");
        if !got.iter().zip(&expected).all(|(value, expected)| is_near(*value, *expected)) {
            all.push(format!("{map} {got:.4?} for {expected:.4?}"));
        }
    }
    all
}

fn options(case: &Value) -> ReadOptions {
    let words: Vec<&str> = case["options"].as_array().unwrap().iter().map(|v| v.as_str().unwrap()).collect();
    match words.as_slice() {
        [] => ReadOptions::AUTO,
        ["--exemplar", number] => {
            ReadOptions { exemplar: Some(number.parse().unwrap()), ..ReadOptions::AUTO }
        }
        other => panic!("an option that this test does not know: {other:?}"),
    }
}

#[test]
#[cfg_attr(not(has_shared), ignore = "../shared is not there")]
fn real_files_are_read_as_their_formats_specify() {
    let cases: Value = serde_json::from_slice(&fs::read(real().join("expected.json")).unwrap()).unwrap();
    let cases = cases.as_object().unwrap();
    assert!(cases.len() >= 18, "{} cases", cases.len());
    let mut wrong = Vec::new();
    for (name, case) in cases {
        let path = real().join(case["path"].as_str().unwrap());
        let problems = match read::<f32>(&path, &options(case), &Progress::default()) {
            Ok(read) => differences(case, &read.material),
            Err(error) => vec![error.to_string()],
        };
        println!(
            "{name}: {}",
            if problems.is_empty() { "as expected".to_owned() } else { problems.join("; ") }
        );
        if !problems.is_empty() {
            wrong.push(format!("{name}: {}", problems.join("; ")));
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}

#[test]
fn a_mean_that_is_off_by_more_than_the_tolerance_is_seen() {
    assert!(is_near(0.5, 0.512) && !is_near(0.5, 0.52) && is_near(0.0, 0.004) && !is_near(0.0, 0.005));
    let planes = |d: f32| svbrdf_core::material::Planes {
        normal: [vec![0.0], vec![0.0], vec![1.0]],
        diffuse: [vec![d], vec![0.2], vec![0.3]],
        specular: [vec![0.04], vec![0.04], vec![0.04]],
        roughness: vec![0.5],
    };
    let case = serde_json::json!({"size": [1, 1], "normal": [0.0, 0.0, 1.0], "diffuse": [0.1, 0.2, 0.3],
        "specular": [0.04, 0.04, 0.04], "roughness": 0.5});
    let material = |d| Material::new("m", 1, 1, planes(d)).unwrap();
    assert!(differences(&case, &material(0.1)).is_empty());
    assert_eq!(differences(&case, &material(0.11)).len(), 1);
}
