//! Depths of the samples of files, and what they leave of a material.

use std::str::FromStr;

use glam::DVec3;
use half::f16;
use rayon::prelude::*;

use super::{Material, Planes};
use crate::error::Error;

/// How samples are stored.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Depth {
    Eight,
    Sixteen,
    Half,
    Float,
}

impl Depth {
    /// The name for users.
    pub fn name(self) -> &'static str {
        match self {
            Self::Eight => "8",
            Self::Sixteen => "16",
            Self::Half => "half",
            Self::Float => "float",
        }
    }
}

impl FromStr for Depth {
    type Err = Error;

    fn from_str(name: &str) -> Result<Self, Error> {
        match name {
            "8" => Ok(Self::Eight),
            "16" => Ok(Self::Sixteen),
            "half" => Ok(Self::Half),
            "float" => Ok(Self::Float),
            _ => Err(Error::unknown_name("depth", name, "8, 16 (PNG), half, float (EXR)")),
        }
    }
}

impl Material<f32> {
    /// The material as it is read back from a file of this depth that this program wrote: EXR for half and float, a packed PNG
    /// of linear values for 8 and 16 bits.
    ///
    /// # Errors
    /// As [`Material::new`], as where a normal becomes too short to have a direction.
    pub fn after_round_trip(&self, depth: Depth) -> Result<Self, Error> {
        let Planes { normal, diffuse, specular, roughness } = self.planes();
        // Normals are stored as (n + 1) / 2.
        let vector = |levels| {
            let component = |x: &f32| {
                let stored = rounded((0.5 * f64::from(*x) + 0.5).clamp(0.0, 1.0), levels);
                (2.0 * stored - 1.0) as f32
            };
            normal.each_ref().map(|plane| plane.iter().map(component).collect())
        };
        let (normal, value): (_, &dyn Fn(f32) -> f32) = match depth {
            Depth::Float => return Ok(self.clone()),
            Depth::Half => {
                (half_normals(normal).map(|plane| plane.into_iter().map(f32::from).collect()), &|x| {
                    f16::from_f32(x).to_f32()
                })
            }
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
        Self::new(self.name(), self.width(), self.height(), planes)
    }
}

/// `value` of [0, 1] to the nearest of `levels` + 1 steps.
fn rounded(value: f64, levels: f64) -> f64 {
    (value * levels).round() / levels
}

/// As [`half_normal`], of planes.
fn half_normals(normal: &[Vec<f32>; 3]) -> [Vec<f16>; 3] {
    const CHUNK: usize = 1 << 14;
    let mut planes = normal.each_ref().map(|plane| vec![f16::ZERO; plane.len()]);
    let [xs, ys, zs] = planes.each_mut().map(|plane| plane.par_chunks_mut(CHUNK));
    xs.zip(ys).zip(zs).enumerate().for_each(|(number, ((xs, ys), zs))| {
        let texels = xs.iter_mut().zip(ys).zip(zs).enumerate();
        for (index, ((x, y), z)) in texels {
            [*x, *y, *z] = half_normal(normal.each_ref().map(|plane| plane[number * CHUNK + index]));
        }
    });
    planes
}

/// The normal in halves which, once they have been normalized and rounded to halves again, are the same.
pub fn half_normal(normal: [f32; 3]) -> [f16; 3] {
    const MOST_ROUNDS: usize = 16;
    let again =
        |n: [f16; 3]| DVec3::from(n.map(f64::from)).normalize().to_array().map(|x| f16::from_f32(x as f32));
    let mut n = normal.map(f16::from_f32);
    for _ in 0..MOST_ROUNDS {
        let next = again(n);
        if next == n {
            break;
        }
        n = next;
    }
    n
}
