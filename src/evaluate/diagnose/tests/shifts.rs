//! Displacements of real materials of large maps, where those are beside the checkout.

use std::path::{Path, PathBuf};

use super::super::pair::Pair;
use super::super::proposals::shift;
use super::super::shift::{Correlations, Interior};
use super::super::trials::{Trials, mean};
use super::super::{Change, Storage, Value, shifted};
use super::materials::with;
use svbrdf_core::loss::{Comparison, Compute as _};
use svbrdf_core::material::{Material, Planes};
use svbrdf_core::math::srgb;
use svbrdf_core::model::convention::PRINTED;
use svbrdf_core::model::sampler::Sampler;
use svbrdf_core::progress::Progress;

/// A set of Poly Haven, with every `step`-th texel of every `step`-th row; `None` without the files.
fn polyhaven(folder: &str, step: usize) -> Option<Material<f32>> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared").join(folder);
    let files: Vec<PathBuf> = std::fs::read_dir(folder).ok()?.map(|entry| entry.unwrap().path()).collect();
    let picture = |part: &str| {
        let path = files.iter().find(|path| path.to_string_lossy().contains(part))?;
        Some(image::open(path).unwrap().to_rgb32f())
    };
    let [colour, arm, normal] = [picture("_diff_")?, picture("_arm_")?, picture("_nor_gl_")?];
    let [width, height] = [colour.width() as usize / step, colour.height() as usize / step];
    let plane = |picture: &image::Rgb32FImage, channel: usize| -> Vec<f32> {
        let at = |i: usize| picture.get_pixel((i % width * step) as u32, (i / width * step) as u32)[channel];
        (0..width * height).map(at).collect()
    };
    let base = [0, 1, 2].map(|c| plane(&colour, c).into_iter().map(srgb::decode).collect::<Vec<f32>>());
    let metallic = plane(&arm, 2);
    let mixed = |of: fn(f32, f32) -> f32| {
        base.each_ref().map(|base| base.iter().zip(&metallic).map(|(b, m)| of(*b, *m)).collect())
    };
    let planes = Planes {
        normal: [0, 1, 2].map(|c| plane(&normal, c).into_iter().map(|n| 2.0 * n - 1.0).collect()),
        diffuse: mixed(|b, m| b * (1.0 - m)),
        specular: mixed(|b, m| 0.04 * (1.0 - m) + b * m),
        roughness: plane(&arm, 1),
    };
    Some(Material::new("polyhaven", width, height, planes).unwrap())
}

/// The displacement that is found, and that by parts of a texel.
fn found([truth, moved]: [&Material<f32>; 2]) -> [Value; 2] {
    let (storage, progress) = (Storage::default(), Progress::default());
    let pair = Pair { ground_truth: truth, prediction: moved, storages: [&storage; 2] };
    let pilot = Trials::new(pair, &PRINTED, [64, 32, 8192], 1, &progress).unwrap();
    let (proposal, subtexel) =
        shift(&pilot, &Correlations::new([truth, moved], 1).fits(None).unwrap()).unwrap();
    [proposal.value, subtexel]
}

/// The share of a shift on the texels that a diagnosis takes, and on all.
fn shares([truth, moved]: [&Material<f32>; 2], by: [i32; 2]) -> [f64; 2] {
    let (storage, progress) = (Storage::default(), Progress::default());
    let pair = Pair { ground_truth: truth, prediction: moved, storages: [&storage; 2] };
    let trials = Trials::new(pair, &PRINTED, [128, 64, 1 << 16], 1, &progress).unwrap();
    let sampled = trials.losses(&[vec![Change::Shift(by)]]).unwrap().remove(0);
    let back = shifted(moved, by.map(|by| -by));
    let predictions = [moved, &back];
    let comparison = Comparison::new(truth, &predictions, PRINTED).unwrap();
    let scenes = Sampler::Sobol.scenes(1, 16, 8, &PRINTED);
    let texels = Interior::new(truth.size(), by.map(|by| -by)).texels();
    let losses = f32::cpu().scene_losses(&comparison, &scenes, Some(&texels), &progress).unwrap();
    [1.0 - mean(&sampled.after) / mean(&sampled.before), 1.0 - mean(&losses[1]) / mean(&losses[0])]
}

const CABINET: &str = "real/polyhaven_cabinet";
const TABLE: &str = "data/polyhaven_arm_wooden_table_02/textures";

/// Predictions are smoother than the ground truth and displaced.
fn displaced(truth: &Material<f32>, by: [i32; 2]) -> Material<f32> {
    with(&shifted(truth, by), |planes| planes.roughness.iter_mut().for_each(|r| *r *= 0.8))
}

#[test]
#[ignore = "takes minutes, and needs ../shared; docs/verification.md has its command and its result"]
fn shifts_of_large_maps_have_the_shares_of_all_texels() {
    for (folder, by) in [(CABINET, [2, 0]), (CABINET, [3, 1]), (TABLE, [8, 0])] {
        let Some(truth) = polyhaven(folder, 1) else { return };
        let moved = displaced(&truth, by);
        let [value, subtexel] = found([&truth, &moved]);
        let [share, of_all] = shares([&truth, &moved], by);
        println!("{folder} {by:?}: found {value}, {subtexel}; share {share:.3}, on all texels {of_all:.3}");
        assert_eq!(value, Value::Displacement(by.map(f64::from)));
        assert!((share - of_all).abs() < 0.03, "{share} {of_all}");
    }
}

#[test]
#[ignore = "takes minutes, and needs ../shared; docs/verification.md has its command and its result"]
fn ninety_six_displacements_are_found_exactly() {
    let (mut exact, mut count, mut largest) = (0, 0, 0.0_f64);
    for truth in [CABINET, TABLE].into_iter().filter_map(|folder| polyhaven(folder, 4)) {
        let steps = [-8, -5, -2, 0, 1, 4, 7];
        for by in steps.into_iter().flat_map(|x| steps.map(|y| [x, y])).filter(|by| *by != [0, 0]) {
            let [value, subtexel] = found([&truth, &displaced(&truth, by)]);
            let is_exact = value == Value::Displacement(by.map(f64::from));
            (exact, count) = (exact + usize::from(is_exact), count + 1);
            let Value::Displacement(subtexel) = subtexel else { panic!("{subtexel:?}") };
            let errors = [0, 1].map(|axis| (subtexel[axis] - f64::from(by[axis])).abs());
            largest = errors.into_iter().fold(largest, f64::max);
            if !is_exact {
                println!("{by:?}: {value}");
            }
        }
    }
    println!("{exact} of {count} displacements are exact; parts of a texel differ by {largest:.2} at most");
    assert!(exact == count && largest < 0.2, "{exact} of {count}, {largest}");
}
