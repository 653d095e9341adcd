//! Causes of a loss: maps, texels, the worst scene.

mod attribution;
mod texels;
mod worst;

use svbrdf_core::material::{Material, Planes};
use svbrdf_core::model::convention::Convention;
use svbrdf_files::samples;

fn built_in() -> [Material<f32>; 3] {
    let built_in = samples::load::<f32>().unwrap();
    let [blurred, rough] = built_in.predictions.try_into().unwrap();
    [built_in.ground_truth.material, blurred.material, rough.material]
}

fn printed() -> Convention {
    Convention::default()
}

/// A material of one normal, the same everywhere, of 8 x 8 texels.
fn uniform(normal: [f64; 3], diffuse: f64, specular: f64, roughness: f64) -> Material<f64> {
    let plane = |value: f64| vec![value; 64];
    let planes = Planes {
        normal: normal.map(plane),
        diffuse: [diffuse; 3].map(plane),
        specular: [specular; 3].map(plane),
        roughness: plane(roughness),
    };
    Material::new("uniform", 8, 8, planes).unwrap()
}
