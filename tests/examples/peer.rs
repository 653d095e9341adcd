//! Times the fused loss on the planes that a peer dumped, and prints the JSON that its benchmark merges.
//!
//! `peer FOLDER SIZE THREADS`: FOLDER holds gt_SIZE.f32 and pred_SIZE.f32 (10 planes: normal xyz, diffuse rgb,
//! roughness, specular rgb, little-endian) and scenes.json. The loss itself goes to stderr.

#![allow(clippy::disallowed_methods, reason = "a program of the tests reads its own files")]

use std::path::Path;
use std::time::Instant;

use svbrdf_core::loss::{Comparison, Request};
use svbrdf_core::material::{Material, Planes};
use svbrdf_core::model::convention::PRINTED;
use svbrdf_core::model::scene::Scene;
use svbrdf_core::progress::Progress;

type Failure = Box<dyn std::error::Error + Send + Sync>;

fn main() -> Result<(), Failure> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [folder, size, threads] = arguments.as_slice() else {
        return Err("usage: peer FOLDER SIZE THREADS".into());
    };
    let (folder, size) = (Path::new(folder), size.parse()?);
    let [gt, prediction] =
        ["gt", "pred"].map(|name| material(&folder.join(format!("{name}_{size}.f32")), size));
    let (gt, prediction) = (gt?, prediction?);
    let scenes: serde_json::Value = serde_json::from_slice(&std::fs::read(folder.join("scenes.json"))?)?;
    let scenes: Vec<Scene> = serde_json::from_value(scenes["scenes"].clone())?;
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads.parse()?).build()?;
    let seconds = pool.install(|| second_call(&gt, &prediction, &scenes))?;
    println!("{}", serde_json::json!({ "svbrdf": { size.to_string(): seconds } }));
    Ok(())
}

/// Seconds of the second call, as the peers are timed.
fn second_call(gt: &Material<f32>, prediction: &Material<f32>, scenes: &[Scene]) -> Result<f64, Failure> {
    let comparison = Comparison::new(gt, &[prediction], PRINTED)?;
    let request = Request::Listed(scenes.to_vec());
    let loss = || comparison.run(&request, &Progress::default());
    eprintln!("loss {:.9}", loss()?.losses[0].estimate.mean);
    let start = Instant::now();
    loss()?;
    Ok(start.elapsed().as_secs_f64())
}

fn material(path: &Path, size: usize) -> Result<Material<f32>, Failure> {
    let bytes = std::fs::read(path)?;
    let numbers: Vec<f32> = bytes.as_chunks().0.iter().map(|b| f32::from_le_bytes(*b)).collect();
    if numbers.len() != 10 * size * size {
        return Err(format!("{}: not 10 planes of {size} x {size}", path.display()).into());
    }
    let plane = |i: usize| numbers[i * size * size..(i + 1) * size * size].to_vec();
    let planes = Planes {
        normal: [0, 1, 2].map(plane),
        diffuse: [3, 4, 5].map(plane),
        roughness: plane(6),
        specular: [7, 8, 9].map(plane),
    };
    Ok(Material::new(path.display().to_string(), size, size, planes)?)
}
