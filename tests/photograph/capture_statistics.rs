//! False outliers and the coverage of intervals over photographs: long, so ignored unless asked for.

use std::fs;
use std::path::Path;

use rand::rngs::ChaCha8Rng;
use rand::{RngExt as _, SeedableRng as _};
use serde_json::{Value, json};
use tempfile::{TempDir, tempdir};

use svbrdf_core::material::Material;
use svbrdf_files::capture::{CaptureGroup, CaptureReport};

use super::captures::{SIDE, of_folder, physical, view, write};
use super::small;
use crate::coverage::measured::{allowed, holds};
use crate::support::pictures::npy;

/// Photographs from which captures are drawn.
const POOL: usize = 400;
/// Photographs of a capture.
const COUNT: usize = 9;

/// Photographs of a material under random lights.
struct Pool {
    folder: TempDir,
    /// Their entries in `capture.json`.
    entries: Vec<Value>,
}

impl Pool {
    /// Each photograph has noise of 3% in each sample and of 0.03 stops in its exposure, and its light is 0.02 half widths from where it is
    /// listed, in each coordinate: standard deviations.
    fn new(material: &Material<f32>) -> Self {
        let (folder, mut generator) = (tempdir().unwrap(), ChaCha8Rng::seed_from_u64(31));
        let entry = |k: usize| {
            let light = [2.0, 2.0, 1.5].map(|width| width * generator.random::<f64>());
            let light = [light[0] - 1.0, light[1] - 1.0, light[2] + 2.0];
            let moved = light.map(|c| c + 0.02 * normal(&mut generator));
            let power = 12.0 * (0.03 * normal(&mut generator)).exp2();
            let noisy = |value: f64| (power * value * (1.0 + 0.03 * normal(&mut generator))) as f32;
            let values: Vec<f32> =
                physical(material, moved, view(light)).into_iter().flatten().map(noisy).collect();
            let file = format!("{k}.npy");
            fs::write(folder.path().join(&file), npy([SIDE as u64, SIDE as u64, 3], &values)).unwrap();
            json!({"file": file, "scene": {"kind": "near", "view": view(light), "light": light}})
        };
        let entries = (0..POOL).map(entry).collect();
        Self { folder, entries }
    }

    fn report(&self, chosen: &[usize], materials: &[&Material<f32>]) -> CaptureReport {
        let listed: Vec<&Value> = chosen.iter().map(|&k| &self.entries[k]).collect();
        let path: &Path = self.folder.path();
        write(path, &json!({"falloff": true, "photographs": listed}));
        of_folder(path, materials)
    }

    /// A capture of different photographs.
    fn sample(&self, seed: u64, materials: &[&Material<f32>]) -> CaptureReport {
        let (mut generator, mut all) = (ChaCha8Rng::seed_from_u64(seed), (0..POOL).collect::<Vec<_>>());
        for i in 0..COUNT {
            all.swap(i, generator.random_range(i..POOL));
        }
        self.report(&all[..COUNT], materials)
    }
}

/// A sample of the standard normal distribution, after Box and Muller.
fn normal(generator: &mut ChaCha8Rng) -> f64 {
    let [u, v] = [(); 2].map(|()| generator.random::<f64>());
    (-2.0 * (1.0 - u).ln()).sqrt() * (std::f64::consts::TAU * v).cos()
}

#[test]
#[ignore = "takes minutes; docs/verification.md has its command and its result"]
fn captures_without_an_outlier_have_none_and_intervals_over_photographs_cover_95_percent() {
    const CAPTURES: u64 = 400;
    let materials = small();
    let pool = Pool::new(&materials[0]);
    let materials = materials.each_ref();
    let group = |report: &CaptureReport, name: &str| -> CaptureGroup {
        let result = report.results.iter().find(|result| result.material == name).unwrap();
        result.groups().remove(0)
    };
    let whole = pool.report(&(0..POOL).collect::<Vec<_>>(), &materials);
    let (mut marked, mut photographs, mut inside) = ([0; 3], [0; 3], [[0; 3]; 3]);
    for seed in 0..CAPTURES {
        let report = pool.sample(seed, &materials);
        for (m, material) in materials.iter().enumerate() {
            let result = report.results.iter().find(|result| result.material == material.name()).unwrap();
            let outliers = result.photographs.iter().filter(|one| one.outlier.is_any()).count();
            marked[m] += u64::from(outliers > 0);
            photographs[m] += outliers;
            let [found, expected] = [&report, &whole].map(|report| group(report, material.name()));
            let pairs = [(found.log, expected.log), (found.rmse, expected.rmse), (found.ssim, expected.ssim)];
            for (inside, (found, expected)) in inside[m].iter_mut().zip(pairs) {
                *inside += u64::from(holds(&found.unwrap(), expected.unwrap().mean));
            }
        }
    }
    let percent = |count: u64| 100.0 * count as f64 / CAPTURES as f64;
    for (m, material) in materials.iter().enumerate() {
        println!(
            "{}: {:.1}% of {CAPTURES} captures have an outlier, {} of {} photographs; coverage of log, RMSE, SSIM {:?}%",
            material.name(),
            percent(marked[m]),
            photographs[m],
            CAPTURES as usize * COUNT,
            inside[m].map(percent)
        );
    }
    assert!(marked.iter().all(|count| percent(*count) <= 5.0), "{marked:?}");
    let [least, most] = allowed(CAPTURES);
    let all = inside.iter().flatten();
    assert!(
        all.clone().all(|count| (least..=most).contains(&percent(*count))),
        "{least} to {most}: {inside:?}"
    );
}
