//! Writes the built-in ground truth, repeated, as large maps: for measuring how reading scales.
//!
//! `cargo run --release --example make_large OUT 4096 8`, then `svbrdf info OUT`. OUT is a folder, or ends in .exr; the
//! depth is 8 or 16 in a folder, half or float in an EXR.

use std::path::Path;
use std::process::ExitCode;

use svbrdf_core::error::Error as CoreError;
use svbrdf_core::material::{Material, Planes};
use svbrdf_files::Error;
use svbrdf_files::samples;
use svbrdf_files::write::{self, Depth, FileKind, WriteOptions};

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [out, side, depth] = arguments.as_slice() else {
        eprintln!("usage: make_large OUT SIDE 8|16|half|float");
        return ExitCode::FAILURE;
    };
    match make(Path::new(out), side, depth) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("{error}");
            ExitCode::FAILURE
        }
    }
}

fn make(out: &Path, side: &str, depth: &str) -> Result<(), Error> {
    let unknown = |_| CoreError::unknown_name("SIDE", side, "a number of texels");
    let side = side.parse().map_err(unknown)?;
    let options = WriteOptions { depth: Some(depth.parse::<Depth>()?), ..WriteOptions::default() };
    write::write(&large(side)?, out, FileKind::new(out, &options)?).map(drop)
}

/// The sample, repeated to fill a square of `side` texels, under a grain that keeps the files from being small.
fn large(side: usize) -> Result<Material<f32>, Error> {
    let sample = samples::load::<f32>()?.ground_truth.material;
    let [width, height] = sample.size();
    let repeated = |plane: &Vec<f32>| -> Vec<f32> {
        let value = |i: usize| plane[i / side % height * width + i % side % width];
        (0..side * side).map(|i| 0.96 * value(i) + 0.02 + 0.02 * grain(i)).collect()
    };
    let Planes { normal, diffuse, specular, roughness } = sample.planes();
    let planes = Planes {
        normal: normal.each_ref().map(repeated),
        diffuse: diffuse.each_ref().map(repeated),
        specular: specular.each_ref().map(repeated),
        roughness: repeated(roughness),
    };
    Ok(Material::new("large", side, side, planes)?)
}

/// White noise in [-1, 1): the finalizer of SplitMix64.
fn grain(index: usize) -> f32 {
    let mut z = (index as u64).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    (z >> 40) as f32 / (1 << 23) as f32 - 1.0
}
