//! Files of public repositories, read as their formats specify: `../shared/real`, decoded independently of this project.

use std::fs;
use std::path::{Path, PathBuf};

use serde_json::Value;

use svbrdf_core::material::Material;
use svbrdf_core::progress::Progress;
use svbrdf_files::Error;
use svbrdf_files::read::{Binding, Certainty, MaterialPath, Read, ReadOptions};
use svbrdf_needs::needs;

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

/// The options and the specified maps of a case.
fn options(case: &Value) -> (ReadOptions, Vec<Binding>) {
    let mut words = case["options"].as_array().unwrap().iter().map(|word| word.as_str().unwrap());
    let (mut options, mut bindings) = (ReadOptions::AUTO, Vec::new());
    while let (Some(option), Some(value)) = (words.next(), words.next()) {
        match option {
            "--exemplar" => options.exemplar = Some(value.parse().unwrap()),
            "--normal-y" => options.normal_y = Some(value.parse().unwrap()),
            "--map" => {
                let (map, file) = value.split_once('=').unwrap();
                bindings.push(format!("{map}={}", real().join(file).display()).parse().unwrap());
            }
            other => panic!("an option that this test does not know: {other}"),
        }
    }
    (options, bindings)
}

/// What is wrong with the reading of a case; nothing where it is as expected, or ends in the message that `must` asks for.
fn problems(case: &Value, result: Result<Read<f32>, Error>) -> Vec<String> {
    let must = case["must"].as_str().unwrap_or_default();
    let read = match result {
        Ok(read) => read,
        Err(_) if must.contains("refuse") => return Vec::new(),
        Err(error) => return vec![error.to_string()],
    };
    let doubts = read.assumptions.iter().any(|assumption| assumption.certainty == Certainty::Unsure);
    match must.split_once("say: ") {
        _ if must == "refuse" => vec!["it must be refused".to_owned()],
        _ if must.contains("doubt") && doubts => Vec::new(),
        Some((_, words)) if !read.notes.iter().any(|note| note.to_string().contains(words)) => {
            vec![format!("no note says {words}")]
        }
        _ => differences(case, &read.material),
    }
}

#[needs(shared)]
#[test]
fn real_files_are_read_as_their_formats_specify() {
    let cases: Value = serde_json::from_slice(&fs::read(real().join("expected.json")).unwrap()).unwrap();
    let cases = cases.as_object().unwrap();
    assert!(cases.len() >= 18, "{} cases", cases.len());
    let (mut wrong, mut doubts) = (Vec::new(), 0);
    for (name, case) in cases {
        let path = real().join(case["path"].as_str().unwrap());
        let (options, bindings) = options(case);
        let read = MaterialPath::new(&path, &options).bound(&bindings).read::<f32>(&Progress::default());
        // A doubt is needless where the values are right all the same.
        if let Ok(read) = &read
            && differences(case, &read.material).is_empty()
        {
            doubts += read.unsure().inspect(|doubt| println!("{name}: {doubt}")).count();
        }
        let problems = problems(case, read);
        println!("{name}: {problems:?}");
        if !problems.is_empty() {
            wrong.push(name.as_str());
        }
    }
    println!("{doubts} needless doubts");
    assert!(wrong.is_empty(), "not read rightly: {wrong:?}");
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
