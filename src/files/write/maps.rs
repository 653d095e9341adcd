//! Maps of a material as the values of pictures: normals, colours, roughness, metallic, and parts of specular.

use svbrdf_core::material::{Material, Planes, base_and_metallic};

use super::curve::Curve;
use crate::read::options::transfer::{encoded, encoded_roughness, linear, roughness};
use crate::read::{Albedo, Energy, NormalY, Preset, ReadOptions, Roughness};

/// The map in a picture.
#[derive(Clone, Copy, Debug)]
pub(super) enum WrittenMap {
    Normal,
    Diffuse,
    Specular,
    Roughness,
    Base,
    Metallic,
    /// Occlusion (none), roughness, metallic.
    Orm,
    /// Specular as a part of a reflectance: how much of it there is, and its tint.
    SpecularWeight(SpecularScale),
    SpecularTint(SpecularScale),
}

/// Specular s as the product of a reflectance, a weight and a tint, s = f w t.
#[derive(Clone, Copy, Debug)]
pub(super) struct SpecularScale {
    /// f, above 0.
    pub reflectance: f64,
    /// How w is stored.
    pub weight: Weight,
}

/// The weight of a [`SpecularScale`].
#[derive(Clone, Copy, Debug)]
pub(super) enum Weight {
    /// 1 everywhere: the tint is all.
    One,
    /// The largest channel of s / f, rounded up to an integer of this many levels: the tint makes up for it.
    Levels(u16),
    /// The largest channel of s / f.
    Exact,
}

impl SpecularScale {
    /// Of specular s, in [0, 1].
    pub(super) fn weight(self, specular: [f64; 3]) -> f64 {
        let share = specular.into_iter().fold(0.0, f64::max) / self.reflectance;
        match self.weight {
            Weight::One => 1.0,
            Weight::Levels(top) => ((share * f64::from(top)).ceil() / f64::from(top)).min(1.0),
            Weight::Exact => share.min(1.0),
        }
    }

    /// White where the weight is 0.
    pub(super) fn tint(self, specular: [f64; 3]) -> [f64; 3] {
        match self.reflectance * self.weight(specular) {
            0.0 => [1.0; 3],
            all => specular.map(|s| (s / all).min(1.0)),
        }
    }
}

/// The encoding of colours and roughness.
#[derive(Clone, Copy, Debug)]
pub(super) struct MapEncoding {
    diffuse: Albedo,
    specular: Albedo,
    roughness: Roughness,
    normal_y: NormalY,
    energy: Energy,
}

impl From<Preset> for MapEncoding {
    fn from(preset: Preset) -> Self {
        let ReadOptions { albedo, specular, roughness, normal_y, energy, .. } = preset.options();
        let diffuse = albedo.unwrap_or(Albedo::Linear);
        Self {
            diffuse,
            specular: specular.unwrap_or(diffuse),
            roughness: roughness.unwrap_or(Roughness::R),
            normal_y: normal_y.unwrap_or(NormalY::Up),
            energy: energy.unwrap_or(Energy::Scaled),
        }
    }
}

impl MapEncoding {
    pub(super) const SRGB: Self = Self {
        diffuse: Albedo::Srgb,
        specular: Albedo::Srgb,
        roughness: Roughness::R,
        normal_y: NormalY::Up,
        energy: Energy::Scaled,
    };
    /// Linear colours.
    pub(super) const LINEAR: Self = Self { diffuse: Albedo::Linear, specular: Albedo::Linear, ..Self::SRGB };
    pub(super) const MATERIAL_GAN: Self = Self {
        diffuse: Albedo::Gamma22,
        specular: Albedo::Gamma22,
        roughness: Roughness::Gamma22,
        ..Self::SRGB
    };

    /// For the metadata of a picture.
    pub(super) fn text(&self) -> String {
        let Self { diffuse, specular, roughness, normal_y, energy } = self;
        format!(
            "diffuse {diffuse}, specular {specular}, roughness {roughness}, normal y {normal_y}, energy {energy}"
        )
    }

    /// The curves of diffuse, of specular, of roughness and of what is stored as it is.
    pub(super) fn curves(&self, sixteen: bool) -> Curves {
        let top = if sixteen { u16::MAX } else { 255 };
        let colour = |albedo| match albedo {
            Albedo::Linear => Curve::plain(top, |value| value),
            _ => Curve::rising(top, move |value| encoded(value, albedo), |value| linear(value, albedo)),
        };
        let code = self.roughness;
        let roughness = match code {
            Roughness::Gamma22 => {
                Curve::rising(top, move |r| encoded_roughness(r, code), |value| roughness(value, code))
            }
            _ => Curve::plain(top, move |r| encoded_roughness(r, code)),
        };
        let plain = Curve::plain(top, |value| value);
        Curves { diffuse: colour(self.diffuse), specular: colour(self.specular), roughness, plain }
    }

    /// (red, green, blue) of the texel at `index` before colours and roughness are encoded, in [0, 1]. A map of numbers has its
    /// number three times.
    pub(super) fn values(&self, material: &Material<f32>, map: WrittenMap, index: usize) -> [f64; 3] {
        let Planes { normal, diffuse, specular, roughness } = material.planes();
        let at = |planes: &[Vec<f32>; 3]| planes.each_ref().map(|plane| f64::from(plane[index]));
        let rough = || f64::from(roughness[index]);
        let base_and_metallic = || base_and_metallic(at(diffuse), at(specular));
        match map {
            WrittenMap::Normal => {
                let [x, y, z] = at(normal);
                let y = if self.normal_y == NormalY::Up { y } else { -y };
                [x, y, z].map(|n| (0.5 * n + 0.5).clamp(0.0, 1.0))
            }
            WrittenMap::Diffuse if self.energy == Energy::Unscaled => {
                let [d, s] = [at(diffuse), at(specular)];
                [0, 1, 2].map(|c| d[c] * (1.0 - s[c]))
            }
            WrittenMap::Diffuse => at(diffuse),
            WrittenMap::Specular => at(specular),
            WrittenMap::Roughness => [rough(); 3],
            WrittenMap::Base => base_and_metallic().0,
            WrittenMap::Metallic => [base_and_metallic().1; 3],
            WrittenMap::Orm => [1.0, rough(), base_and_metallic().1],
            WrittenMap::SpecularWeight(scale) => [scale.weight(at(specular)); 3],
            WrittenMap::SpecularTint(scale) => scale.tint(at(specular)),
        }
    }

    /// (red, green, blue) of the texel at `index`, as integers.
    pub(super) fn codes(
        &self,
        material: &Material<f32>,
        map: WrittenMap,
        index: usize,
        curves: &Curves,
    ) -> [u16; 3] {
        let values = self.values(material, map, index);
        let Curves { diffuse, specular, roughness, plain } = curves;
        let [red, green, blue] = match map {
            WrittenMap::Normal | WrittenMap::Metallic | WrittenMap::SpecularWeight(_) => [plain; 3],
            WrittenMap::Diffuse | WrittenMap::Base => [diffuse; 3],
            WrittenMap::Specular | WrittenMap::SpecularTint(_) => [specular; 3],
            WrittenMap::Roughness => [roughness; 3],
            WrittenMap::Orm => [plain, roughness, plain],
        };
        [red.code(values[0]), green.code(values[1]), blue.code(values[2])]
    }
}

/// How the values of a material become integers.
pub(super) struct Curves {
    diffuse: Curve,
    specular: Curve,
    roughness: Curve,
    plain: Curve,
}
