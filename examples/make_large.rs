//! Writes the built-in ground truth, repeated, as a folder of large maps: for measuring how reading scales.
//!
//! `cargo run --release --example make_large FOLDER 4096`, then `svbrdf info FOLDER`.

use std::path::PathBuf;
use std::process::ExitCode;

use svbrdf::error::Error;
use svbrdf::material::write::{self, Kind};
use svbrdf::material::{Material, Planes};
use svbrdf::samples;

fn main() -> ExitCode {
    let mut arguments = std::env::args().skip(1);
    let folder = arguments.next().map(PathBuf::from);
    let side = arguments.next().and_then(|side| side.parse().ok());
    let (Some(folder), Some(side)) = (folder, side) else {
        eprintln!("usage: make_large FOLDER SIDE");
        return ExitCode::FAILURE;
    };
    match make(side).and_then(|large| write::write(&large, &folder, Kind::new(&folder, None)?)) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("{error}");
            ExitCode::FAILURE
        }
    }
}

/// The sample, repeated to fill a square of `side` texels.
fn make(side: usize) -> Result<Material<f32>, Error> {
    let sample = samples::load::<f32>()?.ground_truth.material;
    let [width, height] = sample.size();
    let repeated = |plane: &Vec<f32>| -> Vec<f32> {
        (0..side * side).map(|i| plane[i / side % height * width + i % side % width]).collect()
    };
    let Planes { normal, diffuse, specular, roughness } = sample.planes();
    let planes = Planes {
        normal: normal.each_ref().map(repeated),
        diffuse: diffuse.each_ref().map(repeated),
        specular: specular.each_ref().map(repeated),
        roughness: repeated(roughness),
    };
    Material::new("large", side, side, planes)
}
