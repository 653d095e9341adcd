//! Maps of a material as the values of pictures: normals, colours, roughness, metallic, and parts of specular.

use svbrdf_core::material::{Material, Planes, base_and_metallic};

use super::curve::Curve;
use crate::read::options::transfer::{encoded_roughness, roughness};
use crate::read::{Albedo, Energy, NormalY, Preset, ReadOptions, Roughness};

/// The map in a picture.
#[derive(Clone, Copy, Debug)]
pub(super) enum WrittenMap {
    Normal,
    Diffuse,
    Specular,
    Roughness,
    Base,
    /// Occlusion (none), roughness, metallic.
    Orm,
    /// Specular as a part of this reflectance.
    SpecularTint(f64),
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
        let colour = |albedo| Curve::encoding(top, albedo);
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

    /// (red, green, blue) of the texel at `index` before colours and roughness are encoded, in [0, 1].
    fn values(&self, material: &Material<f32>, map: WrittenMap, index: usize) -> [f64; 3] {
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
            WrittenMap::Orm => [1.0, rough(), base_and_metallic().1],
            WrittenMap::SpecularTint(reflectance) => at(specular).map(|s| (s / reflectance).min(1.0)),
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
            WrittenMap::Normal => [plain; 3],
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
