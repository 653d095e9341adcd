//! The maps of a glTF material out of its textures and factors.

use gltf::material::{PbrMetallicRoughness, PbrSpecularGlossiness};
use gltf::{Material, Texture};
use rayon::prelude::*;

use super::textures::GltfFile;
use crate::error::Error;
use crate::files::read::formats::principled::{Field, reflectance, separated};
use crate::files::read::formats::scaled_normals::scaled;
use crate::files::read::locate::names::Role;
use crate::files::read::note::Subject;
use crate::files::read::options::Albedo;
use crate::files::read::pictures::Pictures;
use crate::files::read::raster::Raster;
use crate::files::read::stored::StoredMap;
use crate::progress::Progress;

/// The refractive index of a material that says none.
const USUAL_IOR: f32 = 1.5;

/// The pictures of a material, decoded.
pub(super) struct GltfSurface<'a> {
    scene: &'a GltfFile,
    normal: Option<StoredMap>,
    /// Base colour or diffuse.
    colour: Option<StoredMap>,
    /// Roughness and metallic, or specular and glossiness.
    packed: Option<StoredMap>,
    /// The strength of the specular reflection, in alpha.
    specular: Option<StoredMap>,
    specular_colour: Option<StoredMap>,
}

impl<'a> GltfSurface<'a> {
    /// Decodes all textures at once; each is one step of `progress`.
    pub(super) fn load(
        scene: &'a GltfFile,
        material: &Material<'_>,
        progress: &Progress,
    ) -> Result<Self, Error> {
        let normal = material.normal_texture().map(|t| t.texture());
        let extension = material.specular();
        let wanted = if let Some(gloss) = material.pbr_specular_glossiness() {
            let diffuse = gloss.diffuse_texture().map(|t| t.texture());
            let both = gloss.specular_glossiness_texture().map(|t| t.texture());
            [
                (normal, Role::Normal),
                (diffuse, Role::Diffuse),
                (both, Role::Specular),
                (None, Role::Specular),
                (None, Role::Specular),
            ]
        } else {
            let pbr = material.pbr_metallic_roughness();
            let base = pbr.base_color_texture().map(|t| t.texture());
            let both = pbr.metallic_roughness_texture().map(|t| t.texture());
            let strength = extension.as_ref().and_then(|s| s.specular_texture()).map(|t| t.texture());
            let colour = extension.as_ref().and_then(|s| s.specular_color_texture()).map(|t| t.texture());
            [
                (normal, Role::Normal),
                (base, Role::Base),
                (both, Role::Roughness),
                (strength, Role::SpecularLevel),
                (colour, Role::Specular),
            ]
        };
        progress.begin(wanted.len() as u64);
        let load = |(texture, role): (Option<Texture<'_>>, Role)| {
            let source = texture.map(|texture| scene.picture(&texture, Subject::Map(role))).transpose();
            progress.step().and(source)
        };
        let mut loaded = wanted.into_par_iter().map(load).collect::<Result<Vec<_>, _>>()?.into_iter();
        let mut next = || loaded.next().flatten();
        let normal = next().map(|source| {
            let scale = material.normal_texture().map_or(1.0, |texture| f64::from(texture.scale()));
            scaled(source, scale)
        });
        Ok(Self { scene, normal, colour: next(), packed: next(), specular: next(), specular_colour: next() })
    }

    /// Puts the maps into `pictures`; returns whether colours are linear.
    pub(super) fn put(mut self, material: &Material<'_>, pictures: &mut Pictures) -> Result<bool, Error> {
        let all = [&self.normal, &self.colour, &self.packed, &self.specular, &self.specular_colour];
        all.into_iter().flatten().for_each(|source| pictures.record_size(source.raster.size()));
        if let Some(normal) = self.normal.take() {
            pictures.add(Role::Normal, normal);
        }
        match material.pbr_specular_glossiness() {
            Some(gloss) => {
                self.put_specular_glossiness(&gloss, pictures);
                Ok(false)
            }
            None => self.put_metallic_roughness(material, pictures),
        }
    }

    fn put_metallic_roughness(self, material: &Material<'_>, pictures: &mut Pictures) -> Result<bool, Error> {
        let pbr = material.pbr_metallic_roughness();
        let [roughness, metallic] = self.roughness_and_metallic(&pbr);
        let [r, g, b, _] = pbr.base_color_factor();
        let dielectric = self.dielectric(material)?;
        pictures.add(Role::Roughness, roughness);
        if dielectric.is(reflectance(USUAL_IOR)) {
            pictures.add(Role::Metallic, metallic);
            pictures.add(Role::Base, self.colour(self.colour.clone(), [r, g, b]));
            return Ok(false);
        }
        let base = match &self.colour {
            Some(source) => Field::of(source, Albedo::Srgb).times(Field::constant(&[r, g, b]))?,
            None => Field::constant(&[r, g, b]),
        };
        let [diffuse, specular] = separated(base, Field::of(&metallic, Albedo::Linear), dielectric)?;
        pictures.add(Role::Diffuse, diffuse.into_source(&self.scene.path, "base colour and metallic"));
        pictures
            .add(Role::Specular, specular.into_source(&self.scene.path, "KHR_materials_specular and _ior"));
        Ok(true)
    }

    fn roughness_and_metallic(&self, pbr: &PbrMetallicRoughness<'_>) -> [StoredMap; 2] {
        let channel = |number: usize, factor: f32| match &self.packed {
            Some(packed) => {
                StoredMap { raster: packed.raster.channel(number).scaled(&[factor]), ..packed.clone() }
            }
            None => StoredMap::constant(&self.scene.path, &[factor]),
        };
        [channel(1, pbr.roughness_factor()), channel(2, pbr.metallic_factor())]
    }

    /// What the dielectric reflects at normal incidence: min(reflectance(ior) * colour, 1) * strength, by
    /// KHR_materials_ior and KHR_materials_specular.
    fn dielectric(&self, material: &Material<'_>) -> Result<Field, Error> {
        let plain = Field::constant(&[reflectance(material.ior().unwrap_or(USUAL_IOR))]);
        let Some(said) = material.specular() else { return Ok(plain) };
        let mut colour = plain.times(Field::constant(&said.specular_color_factor()))?;
        if let Some(source) = &self.specular_colour {
            colour = colour.times(Field::of(source, Albedo::Srgb))?;
        }
        let mut strength = Field::constant(&[said.specular_factor()]);
        // Alpha that is 1 everywhere is not kept.
        if let Some((source, alpha)) = self.specular.as_ref().and_then(|s| Some((s, s.raster.alpha.clone()?)))
        {
            let raster = source.raster.of(alpha);
            strength = strength.times(Field::of(&StoredMap { raster, ..source.clone() }, Albedo::Linear))?;
        }
        colour.at_most_one().times(strength)
    }

    /// Diffuse, specular and glossiness of the extension `KHR_materials_pbrSpecularGlossiness`.
    fn put_specular_glossiness(self, pbr: &PbrSpecularGlossiness<'_>, pictures: &mut Pictures) {
        let factor = pbr.glossiness_factor();
        let gloss = match &self.packed {
            // Alpha that is 1 everywhere is not kept.
            Some(StoredMap { raster, .. }) => match raster.alpha.clone() {
                Some(alpha) => raster.of(alpha).scaled(&[factor]),
                None => Raster::constant("alpha", &[factor]),
            },
            None => Raster::constant("factor", &[factor]),
        };
        let file = self.packed.as_ref().map_or(&self.scene.path, |source| &source.file).clone();
        let [r, g, b, _] = pbr.diffuse_factor();
        pictures.add(Role::Diffuse, self.colour(self.colour.clone(), [r, g, b]));
        pictures.add(Role::Specular, self.colour(self.packed.clone(), pbr.specular_factor()));
        pictures.add(Role::Roughness, StoredMap { raster: gloss, file, part: "alpha".to_owned() });
    }

    /// The sRGB picture of a colour times a linear factor, in sRGB.
    fn colour(&self, source: Option<StoredMap>, factor: [f32; 3]) -> StoredMap {
        let source = source.unwrap_or_else(|| StoredMap::constant(&self.scene.path, &[1.0; 3]));
        source.times(factor, Albedo::Srgb)
    }
}
