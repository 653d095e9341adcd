//! Other readings of the values of a material: sign of normals, encoding of colours, meaning of roughness.

use super::storage::{Storage, Transfer};
use crate::error::Error;
use crate::material::{Material, Planes};

/// A change of how the values of a prediction are read, made from the values as they were read.
///
/// With base colour and metallic, diffuse and specular follow from both; there the change is an approximation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reading {
    /// The y axis of normals in the other direction.
    NormalY,
    /// The x axis of normals in the other direction.
    NormalX,
    /// Diffuse and specular in this encoding instead.
    Colours(Transfer),
    /// Specular in this encoding instead.
    Specular(Transfer),
    /// r = 1 - c.
    Gloss,
    /// r = sqrt(c): the values are alpha.
    RootOfRoughness,
    /// r = c^2.
    SquaredRoughness,
    /// Red and blue of diffuse and specular swapped.
    RedBlue,
    /// d / (1 - s): diffuse was not scaled by (1 - specular).
    Unscaled,
    /// d (1 - s): the inverse.
    Scaled,
}

impl Reading {
    /// Its value in reports.
    pub fn name(self) -> &'static str {
        match self {
            Self::NormalY | Self::NormalX => "flipped",
            Self::Colours(Transfer::Linear) | Self::Specular(Transfer::Linear) => "linear",
            Self::Colours(_) | Self::Specular(_) => "srgb",
            Self::Gloss => "gloss",
            Self::RootOfRoughness => "root",
            Self::SquaredRoughness => "square",
            Self::RedBlue => "swapped",
            Self::Unscaled => "unscaled",
            Self::Scaled => "scaled",
        }
    }

    /// `material`, whose values were read from `storage`, in this reading.
    ///
    /// # Errors
    /// Those of [`Material::new`], which values of a material do not give.
    pub fn applied(self, material: &Material<f32>, storage: &Storage) -> Result<Material<f32>, Error> {
        let mut planes = material.planes().clone();
        match self {
            Self::NormalY => negate(&mut planes.normal[1]),
            Self::NormalX => negate(&mut planes.normal[0]),
            Self::Colours(to) => {
                planes.diffuse.iter_mut().for_each(|plane| reencode(plane, storage.colours, to));
                planes.specular.iter_mut().for_each(|plane| reencode(plane, storage.specular, to));
            }
            Self::Specular(to) => {
                planes.specular.iter_mut().for_each(|plane| reencode(plane, storage.specular, to));
            }
            Self::Gloss => planes.roughness.iter_mut().for_each(|r| *r = 1.0 - *r),
            Self::RootOfRoughness => planes.roughness.iter_mut().for_each(|r| *r = r.sqrt()),
            Self::SquaredRoughness => planes.roughness.iter_mut().for_each(|r| *r *= *r),
            Self::RedBlue => {
                planes.diffuse.swap(0, 2);
                planes.specular.swap(0, 2);
            }
            Self::Unscaled => scale(&mut planes, |d, s| if s < 1.0 { (d / (1.0 - s)).min(1.0) } else { 0.0 }),
            Self::Scaled => scale(&mut planes, |d, s| d * (1.0 - s)),
        }
        Material::new(material.name(), material.width(), material.height(), planes)
    }
}

fn negate(plane: &mut [f32]) {
    plane.iter_mut().for_each(|x| *x = -*x);
}

/// Values that were decoded from `from`, decoded from `to` instead. Values of an unknown encoding were decoded from the other one.
fn reencode(plane: &mut [f32], from: Transfer, to: Transfer) {
    let from = match (from, to) {
        (Transfer::Unknown, Transfer::Linear) => Transfer::Srgb,
        (from, _) => from,
    };
    plane.iter_mut().for_each(|x| *x = to.decode(from.encode(*x)).clamp(0.0, 1.0));
}

fn scale(planes: &mut Planes<f32>, scaled: impl Fn(f32, f32) -> f32) {
    for (diffuse, specular) in planes.diffuse.iter_mut().zip(&planes.specular) {
        diffuse.iter_mut().zip(specular).for_each(|(d, s)| *d = scaled(*d, *s));
    }
}
