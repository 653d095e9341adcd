//! The glTF and MaterialX files of `../shared/real`, decoded independently by the rules of their formats.

use serde_json::Value;
use svbrdf_files::read::ReadOptions;

use super::*;

/// Absolute and relative tolerance of means, as the README of the folder says.
const TOLERANCE: [f64; 2] = [4e-3, 2.5e-2];

fn mean(plane: &[f64]) -> f64 {
    plane.iter().sum::<f64>() / plane.len() as f64
}

/// What is wrong with the material of `case`, if anything.
fn wrong(folder: &Path, case: &Value) -> Option<String> {
    let path = folder.join(case["path"].as_str()?);
    let exemplar = case["options"].as_array()?.get(1).and_then(|index| index.as_str()?.parse().ok());
    let options = ReadOptions { exemplar, ..ReadOptions::AUTO };
    let read = match read::<f64>(&path, &options, &Progress::default()) {
        Ok(read) => read,
        Err(error) => return Some(error.to_string()),
    };
    let planes = read.material.planes();
    let got = planes.normal.iter().chain(&planes.diffuse).chain(&planes.specular).chain([&planes.roughness]);
    let got: Vec<f64> = got.map(|plane| mean(plane)).collect();
    let expected = ["normal", "diffuse", "specular"].into_iter().flat_map(|map| case[map].as_array());
    let expected: Vec<f64> =
        expected.flatten().chain([&case["roughness"]]).filter_map(Value::as_f64).collect();
    let is_near = |(a, b): (&f64, &f64)| (a - b).abs() <= TOLERANCE[0].max(TOLERANCE[1] * b.abs());
    let is_same = got.len() == expected.len() && got.iter().zip(&expected).all(is_near);
    (!is_same).then(|| format!("{got:.4?}, not {expected:.4?}"))
}

#[test]
#[cfg_attr(not(has_shared), ignore = "../shared is not there")]
fn real_gltf_and_materialx_have_the_means_of_an_independent_decoder() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/real");
    let text = std::fs::read_to_string(folder.join("expected.json")).unwrap();
    let cases: serde_json::Map<String, Value> = serde_json::from_str(&text).unwrap();
    let names = |case: &Value| {
        let path = case["path"].as_str().unwrap_or_default();
        [".gltf", ".glb", ".mtlx"].iter().any(|extension| path.ends_with(extension))
    };
    let mut tried = 0;
    let mut problems = Vec::new();
    for (name, case) in cases.iter().filter(|(_, case)| names(case)) {
        tried += 1;
        problems.extend(wrong(&folder, case).map(|problem| format!("{name}: {problem}")));
        // The comparison can fail.
        let mut other = case.clone();
        other["roughness"] = Value::from(case["roughness"].as_f64().unwrap() + 0.05);
        assert!(wrong(&folder, &other).is_some(), "{name}");
    }
    assert!(tried >= 10, "{tried}");
    assert!(problems.is_empty(), "{problems:#?}");
}
