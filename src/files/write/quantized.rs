//! Quantization: a material after a round trip through a file.

use exr::prelude::f16;

use super::Depth;
use super::exr::half_normals;
use crate::error::Error;
use crate::material::{Material, Planes};

/// `material` as it is read back from a file of this depth that this module wrote: EXR for half and float, a packed PNG
/// of linear values for 8 and 16 bits.
///
/// # Errors
/// As [`Material::new`], as where a normal becomes too short to have a direction.
pub fn after_round_trip(material: &Material<f32>, depth: Depth) -> Result<Material<f32>, Error> {
    let Planes { normal, diffuse, specular, roughness } = material.planes();
    // Normals are stored as (n + 1) / 2.
    let vector = |levels| {
        let component = |x: &f32| {
            let stored = rounded((0.5 * f64::from(*x) + 0.5).clamp(0.0, 1.0), levels);
            (2.0 * stored - 1.0) as f32
        };
        normal.each_ref().map(|plane| plane.iter().map(component).collect())
    };
    let (normal, value): (_, &dyn Fn(f32) -> f32) = match depth {
        Depth::Float => return Ok(material.clone()),
        Depth::Half => (half_normals(normal).map(|plane| plane.into_iter().map(f32::from).collect()), &|x| {
            f16::from_f32(x).to_f32()
        }),
        Depth::Eight => (vector(255.0), &|x| rounded(x.into(), 255.0) as f32),
        Depth::Sixteen => (vector(65_535.0), &|x| rounded(x.into(), 65_535.0) as f32),
    };
    let plane = |plane: &Vec<f32>| plane.iter().map(|&x| value(x)).collect();
    let planes = Planes {
        normal,
        diffuse: diffuse.each_ref().map(plane),
        specular: specular.each_ref().map(plane),
        roughness: plane(roughness),
    };
    Material::new(material.name(), material.width(), material.height(), planes)
}

/// `value` of [0, 1] to the nearest of `levels` + 1 steps.
fn rounded(value: f64, levels: f64) -> f64 {
    (value * levels).round() / levels
}
