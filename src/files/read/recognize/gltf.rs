//! Materials of a glTF: maps out of its textures and factors, as the specification of glTF 2.0 defines them.

use std::path::{Path, PathBuf};

use super::field::{Field, reflectance, separated};
use super::roles::MapsByRole;
use super::scaled_normals::scaled;
use crate::error::Error;
use crate::read::decode::pictures::DecodedPicture;
use crate::read::located::gltf::{GltfSurface, LocatedGltf};
use crate::read::options::{Albedo, NormalEncoding, NormalY, ReadOptions, Role, Roughness};
use crate::read::raster::Raster;
use crate::read::record::{Assumption, Certainty, Note, StorageConvention, What};
use crate::read::stored::{StoredMap, StoredMaterial};

/// The refractive index of a material that declares none.
const DEFAULT_IOR: f32 = 1.5;

/// The material `located`, whose textures are `pictures`.
///
/// # Errors
/// [`Error::NotAMaterial`] without a map that is needed.
pub(super) fn material(
    located: LocatedGltf,
    pictures: Vec<DecodedPicture>,
    options: &ReadOptions,
) -> Result<StoredMaterial, Error> {
    let LocatedGltf { path, name, surface, textures, normal_scale, buffers, not_modelled, materials, .. } =
        located;
    let mut maps = MapsByRole::default();
    pictures.iter().for_each(|picture| maps.record_size(picture.map.raster.size()));
    let map = |texture: Option<usize>| Some(pictures.get(texture?)?.map.clone());
    if let Some(normal) = map(textures.normal) {
        maps.add(Role::Normal, scaled(normal, normal_scale.into()));
    }
    let textures = Textures {
        path: &path,
        colour: map(textures.colour),
        packed: map(textures.packed),
        specular: map(textures.specular),
        specular_colour: map(textures.specular_colour),
    };
    let is_linear = textures.add_to(&mut maps, surface);
    let mut found = maps.material(&path, name, "", options)?;
    for file in buffers {
        let by = file.outside().map(Path::to_owned);
        found.notes.extend(by.map(|by| Note::OutsideFolder { file: file.path().to_owned(), by }));
        found.add_file(file.path().to_owned());
    }
    found.add_file(path);
    // The pictures of computed maps, too: no output may replace them.
    pictures.iter().for_each(|picture| found.add_file(picture.map.file.clone()));
    let roughness = match surface {
        GltfSurface::SpecularGlossiness { .. } => Roughness::Gloss,
        GltfSurface::MetallicRoughness { .. } => Roughness::R,
    };
    found.is_mapped = true;
    specify(&mut found, roughness, is_linear);
    if !not_modelled.is_empty() {
        found.notes.push(Note::NotModelled { features: not_modelled });
    }
    let (names, index) = materials;
    if names.len() > 1 {
        found.notes.push(Note::Materials { names, index });
    }
    Ok(found)
}

/// Records the encodings of the specification.
fn specify(found: &mut StoredMaterial, roughness: Roughness, is_linear: bool) {
    let why = || StorageConvention::Gltf.into();
    let albedo = if is_linear { Albedo::Linear } else { Albedo::Srgb };
    found.inferred.albedo = Some((albedo, why(), Certainty::Sure));
    found.inferred.specular = found.inferred.albedo.clone();
    found.inferred.roughness = Some((roughness, why(), Certainty::Sure));
    found.inferred.normal_y = Some((NormalY::Up, why(), Certainty::Sure));
    found.inferred.normal_encoding = Some((NormalEncoding::Unsigned, why(), Certainty::Sure));
    let layout = Assumption::new(What::Layout, "glTF", StorageConvention::ListedTextures, Certainty::Sure);
    found.assumptions.insert(0, layout);
}

/// The textures of a material but the normals.
struct Textures<'a> {
    path: &'a Path,
    /// Base colour or diffuse.
    colour: Option<StoredMap>,
    /// Roughness and metallic, or specular and glossiness.
    packed: Option<StoredMap>,
    /// The strength of the specular reflection, in alpha.
    specular: Option<StoredMap>,
    specular_colour: Option<StoredMap>,
}

impl Textures<'_> {
    /// Adds the maps of the surface to `maps`; returns whether their colours are linear.
    fn add_to(&self, maps: &mut MapsByRole, surface: GltfSurface) -> bool {
        match surface {
            GltfSurface::SpecularGlossiness { diffuse, specular, glossiness } => {
                maps.add(Role::Diffuse, self.colour(self.colour.clone(), diffuse));
                maps.add(Role::Specular, self.colour(self.packed.clone(), specular));
                maps.add(Role::Roughness, self.glossiness(glossiness));
                false
            }
            GltfSurface::MetallicRoughness { base, roughness, metallic, ior, specular } => {
                let dielectric = self.dielectric(ior, specular);
                maps.add(Role::Roughness, self.channel(1, roughness));
                self.add_reflectance(maps, base, self.channel(2, metallic), dielectric)
            }
        }
    }

    /// Adds base colour and metallic, or diffuse and specular where the dielectric is not the default one.
    fn add_reflectance(
        &self,
        maps: &mut MapsByRole,
        base: [f32; 3],
        metallic: StoredMap,
        dielectric: Field,
    ) -> bool {
        if dielectric.is(reflectance(DEFAULT_IOR)) {
            maps.add(Role::Metallic, metallic);
            maps.add(Role::Base, self.colour(self.colour.clone(), base));
            return false;
        }
        let base = match &self.colour {
            Some(map) => Field::of(map, Albedo::Srgb).times(Field::constant(&base)),
            None => Field::constant(&base),
        };
        let [diffuse, specular] = separated(base, Field::of(&metallic, Albedo::Linear), dielectric);
        maps.add(Role::Diffuse, diffuse.into_map(self.path, "base colour and metallic"));
        maps.add(Role::Specular, specular.into_map(self.path, "KHR_materials_specular and _ior"));
        true
    }

    /// A channel of roughness and metallic times its factor.
    fn channel(&self, number: usize, factor: f32) -> StoredMap {
        match &self.packed {
            Some(packed) => {
                StoredMap { raster: packed.raster.channel(number).scaled(&[factor]), ..packed.clone() }
            }
            None => StoredMap::constant(self.path, &[factor]),
        }
    }

    /// The reflectance of the dielectric at normal incidence: min(reflectance(ior) * colour, 1) * strength, by
    /// KHR_materials_ior and KHR_materials_specular.
    fn dielectric(&self, ior: Option<f32>, specular: Option<(f32, [f32; 3])>) -> Field {
        let plain = Field::constant(&[reflectance(ior.unwrap_or(DEFAULT_IOR))]);
        let Some((strength, colour)) = specular else { return plain };
        let mut colour = plain.times(Field::constant(&colour));
        if let Some(map) = &self.specular_colour {
            colour = colour.times(Field::of(map, Albedo::Srgb));
        }
        let mut strength = Field::constant(&[strength]);
        // Alpha that is 1 everywhere is not stored.
        if let Some((map, alpha)) = self.specular.as_ref().and_then(|s| Some((s, s.raster.alpha.clone()?))) {
            let raster = map.raster.of(alpha);
            strength = strength.times(Field::of(&StoredMap { raster, ..map.clone() }, Albedo::Linear));
        }
        colour.at_most_one().times(strength)
    }

    /// Alpha of specular and glossiness times a factor.
    fn glossiness(&self, factor: f32) -> StoredMap {
        let raster = match &self.packed {
            // Alpha that is 1 everywhere is not stored.
            Some(StoredMap { raster, .. }) => match raster.alpha.clone() {
                Some(alpha) => raster.of(alpha).scaled(&[factor]),
                None => Raster::constant("alpha", &[factor]),
            },
            None => Raster::constant("factor", &[factor]),
        };
        let file = self.packed.as_ref().map_or_else(|| PathBuf::from(self.path), |map| map.file.clone());
        StoredMap { raster, file, part: "alpha".to_owned() }
    }

    /// The sRGB picture of a colour times a linear factor, in sRGB.
    fn colour(&self, map: Option<StoredMap>, factor: [f32; 3]) -> StoredMap {
        let map = map.unwrap_or_else(|| StoredMap::constant(self.path, &[1.0; 3]));
        map.times(factor, Albedo::Srgb)
    }
}
