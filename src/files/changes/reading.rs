//! Other readings of the values of a material (sign of normals, encoding of colours, meaning of roughness), and the options that have them.

use serde::{Deserialize, Serialize};

use svbrdf_core::error::Error;
use svbrdf_core::material::{Material, Planes};

use crate::read::{Albedo, Energy, NormalY, ReadOptions, Roughness, Storage};

/// The reflectance f of dielectrics where no map holds it.
const DIELECTRIC: f32 = 0.04;

/// A change of how the values of a prediction are read, made from the values as they were read.
///
/// A base colour and metallic are recovered from diffuse and specular, for a reflectance of dielectrics of 0.04.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Reading {
    /// The y axis of normals in the other direction.
    NormalY,
    /// The x axis of normals in the other direction.
    NormalX,
    /// Diffuse and specular in this encoding instead.
    Colours(Albedo),
    /// Diffuse alone in this encoding instead.
    Diffuse(Albedo),
    /// Specular alone in this encoding instead.
    Specular(Albedo),
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
            Self::Colours(to) | Self::Diffuse(to) | Self::Specular(to) => to.name(),
            Self::Gloss => "gloss",
            Self::RootOfRoughness => "root",
            Self::SquaredRoughness => "square",
            Self::RedBlue => "swapped",
            Self::Unscaled => "unscaled",
            Self::Scaled => "scaled",
        }
    }

    /// What it does, for titles.
    pub fn words(self) -> &'static str {
        match self {
            Self::NormalY => "Y of normals flipped",
            Self::NormalX => "X of normals flipped",
            Self::Colours(Albedo::Linear) => "colours read as linear",
            Self::Colours(Albedo::Gamma22) => "colours read as gamma 2.2",
            Self::Colours(_) => "colours read as sRGB",
            Self::Diffuse(Albedo::Linear) => "diffuse read as linear",
            Self::Diffuse(Albedo::Gamma22) => "diffuse read as gamma 2.2",
            Self::Diffuse(_) => "diffuse read as sRGB",
            Self::Specular(Albedo::Linear) => "specular read as linear",
            Self::Specular(Albedo::Gamma22) => "specular read as gamma 2.2",
            Self::Specular(_) => "specular read as sRGB",
            Self::Gloss => "1 - roughness",
            Self::RootOfRoughness => "root of roughness",
            Self::SquaredRoughness => "square of roughness",
            Self::RedBlue => "red and blue swapped",
            Self::Unscaled => "diffuse read as unscaled",
            Self::Scaled => "diffuse read as scaled",
        }
    }

    /// `material`, whose values were read from `storage`, in this reading.
    ///
    /// # Errors
    /// Those of [`Material::new`], which values of a material do not give.
    pub fn applied(self, material: &Material<f32>, storage: &Storage) -> Result<Material<f32>, Error> {
        if storage.unscaled && matches!(self, Self::Colours(_) | Self::Diffuse(_) | Self::Specular(_)) {
            let stored = Self::Scaled.applied(material, storage)?;
            let read = self.applied(&stored, &Storage { unscaled: false, ..storage.clone() })?;
            return Self::Unscaled.applied(&read, storage);
        }
        let mut planes = material.planes().clone();
        match self {
            Self::NormalY => negate(&mut planes.normal[1]),
            Self::NormalX => negate(&mut planes.normal[0]),
            Self::Colours(to) if storage.base_colour => reencode_base(&mut planes, storage.colours, to),
            Self::Colours(to) => {
                planes.diffuse.iter_mut().for_each(|plane| reencode(plane, storage.colours, to));
                planes.specular.iter_mut().for_each(|plane| reencode(plane, storage.specular, to));
            }
            Self::Diffuse(to) => {
                planes.diffuse.iter_mut().for_each(|plane| reencode(plane, storage.colours, to));
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
            Self::Unscaled => scale(&mut planes, |d, s| if d < 1.0 - s { d / (1.0 - s) } else { d.signum() }),
            Self::Scaled => scale(&mut planes, |d, s| d * (1.0 - s)),
        }
        Material::new(material.name(), material.width(), material.height(), planes)
    }

    /// The options that read a material, which was read from `storage`, in this reading; `None`: there are none.
    pub fn remedy(self, storage: &Storage) -> Option<ReadOptions> {
        let auto = ReadOptions::AUTO;
        let roughness = |to| ReadOptions { roughness: Some(to), ..auto };
        // `albedo` alone would change specular, too, unless an option specifies `specular-albedo`.
        let albedo = |to, specular: Albedo| {
            let specular = (!storage.base_colour).then_some(specular);
            ReadOptions { albedo: Some(to), specular, ..auto }
        };
        Some(match (self, storage.roughness) {
            (Self::NormalY, _) => {
                let y = if storage.normal_down { NormalY::Up } else { NormalY::Down };
                ReadOptions { normal_y: Some(y), ..auto }
            }
            (Self::Colours(to), _) => albedo(to, to),
            (Self::Diffuse(to), _) => albedo(to, storage.specular?),
            (Self::Specular(to), _) => ReadOptions { specular: Some(to), ..auto },
            (Self::Gloss, Roughness::Gloss) | (Self::SquaredRoughness, Roughness::Alpha) => {
                roughness(Roughness::R)
            }
            (Self::Gloss, Roughness::R) => roughness(Roughness::Gloss),
            (Self::RootOfRoughness, Roughness::R) => roughness(Roughness::Alpha),
            (Self::Unscaled, _) => ReadOptions { energy: Some(Energy::Unscaled), ..auto },
            (Self::Scaled, _) => ReadOptions { energy: Some(Energy::Scaled), ..auto },
            _ => return None,
        })
    }
}

fn negate(plane: &mut [f32]) {
    plane.iter_mut().for_each(|x| *x = -*x);
}

/// Values that were decoded from `from`, decoded from `to` instead. Values of an unknown encoding were decoded from the other one.
fn reencode(plane: &mut [f32], from: Option<Albedo>, to: Albedo) {
    let from = from.or((to == Albedo::Linear).then_some(Albedo::Srgb));
    plane.iter_mut().for_each(|x| *x = Storage::decode(Some(to), Storage::encode(from, *x)).clamp(0.0, 1.0));
}

/// The same for a base colour b and metallic m, from which d = b (1 - m) and s = f (1 - m) + b m follow. The means of d and s over the
/// channels give m: f m^2 + (d + s - 2 f) m = s - f.
fn reencode_base(planes: &mut Planes<f32>, from: Option<Albedo>, to: Albedo) {
    let Planes { diffuse, specular, .. } = planes;
    for index in 0..diffuse[0].len() {
        let mean = |map: &[Vec<f32>; 3]| map.iter().map(|plane| plane[index]).sum::<f32>() / 3.0;
        let (d, s) = (mean(diffuse), mean(specular));
        // Darker metals than dielectrics cannot be told from dielectrics.
        let rest = if s - DIELECTRIC > 1e-4 { s - DIELECTRIC } else { 0.0 };
        let half = 0.5 * (d + s) - DIELECTRIC;
        let root = half + (half * half + DIELECTRIC * rest).sqrt();
        let metallic = if root > 0.0 { (rest / root).clamp(0.0, 1.0) } else { 0.0 };
        let of_dielectric = DIELECTRIC * (1.0 - metallic);
        let mut base: Vec<f32> = (0..3)
            .map(|c| (diffuse[c][index] + specular[c][index] - of_dielectric).clamp(0.0, 1.0))
            .collect();
        reencode(&mut base, from, to);
        for (c, b) in base.into_iter().enumerate() {
            diffuse[c][index] = b * (1.0 - metallic);
            specular[c][index] = (of_dielectric + b * metallic).clamp(0.0, 1.0);
        }
    }
}

fn scale(planes: &mut Planes<f32>, scaled: impl Fn(f32, f32) -> f32) {
    for (diffuse, specular) in planes.diffuse.iter_mut().zip(&planes.specular) {
        diffuse.iter_mut().zip(specular).for_each(|(d, s)| *d = scaled(*d, *s));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_base_colour_is_encoded_before_metallic_separates_it() {
        let material = |base: &dyn Fn(f32) -> f32| {
            let values = [(0.3, 0.0), (0.5, 1.0), (0.7, 0.4), (0.3, 0.9)];
            let plane = |of: &dyn Fn(f32, f32) -> f32| -> [Vec<f32>; 3] {
                [0.5, 0.8, 1.0].map(|tint| values.iter().map(|&(b, m)| of(base(tint * b), m)).collect())
            };
            let planes = Planes {
                normal: [vec![0.0; 4], vec![0.0; 4], vec![1.0; 4]],
                diffuse: plane(&|b, m| b * (1.0 - m)),
                specular: plane(&|b, m| 0.04 * (1.0 - m) + b * m),
                roughness: vec![0.5; 4],
            };
            Material::new("metal", 4, 1, planes).unwrap()
        };
        let storage = Storage { colours: Some(Albedo::Linear), base_colour: true, ..Storage::default() };
        let found = Reading::Colours(Albedo::Srgb).applied(&material(&|b| b), &storage).unwrap();
        let expected = material(&svbrdf_core::math::srgb::decode);
        for (found, expected) in [(found.planes(), expected.planes())] {
            let of = |planes: &Planes<f32>| {
                planes.diffuse.iter().chain(&planes.specular).flatten().copied().collect::<Vec<_>>()
            };
            for (found, expected) in of(found).into_iter().zip(of(expected)) {
                assert!((found - expected).abs() < 1e-5, "{found} {expected}");
            }
        }
    }
}
