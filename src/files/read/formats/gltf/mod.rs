//! Materials of glTF 2.0: maps out of the textures and factors, as the specification defines them.

mod document;
mod features;
mod material;

use std::path::{Path, PathBuf};

use svbrdf_core::progress::Progress;

use crate::disk::open::NamedFile;
use crate::error::Error;
use crate::read::options::{Albedo, NormalEncoding, ReadOptions, Role, Roughness};
use crate::read::raster::Raster;
use crate::read::record::{Assumption, Certainty, Note, Reason, Subject, What};
use crate::read::stored::{
    Field, Inferences, MapsByRole, Picture, StoredMap, StoredMaterial, decoded, notice, reflectance,
    separated,
};

use document::GltfDocument;
use material::GltfMaterial;

/// The refractive index of a material that declares none.
const DEFAULT_IOR: f32 = 1.5;

/// A material of a glTF, its textures located.
#[derive(Debug)]
pub(in crate::read) struct Gltf {
    path: PathBuf,
    pub name: String,
    material: GltfMaterial,
    /// One for each texture of the material.
    pictures: Vec<Picture>,
    /// The files of its buffers: pictures, vertex colours and meshes.
    buffers: Vec<NamedFile>,
    /// Features that change the look and are not modelled.
    not_modelled: Vec<String>,
    /// The names of all materials of the file, and which of them this is.
    materials: (Vec<String>, usize),
}

impl Gltf {
    /// Locates material number `exemplar` of the file `path`; without one the first that has a texture, else the first.
    ///
    /// # Errors
    /// [`Error::Unreadable`], [`Error::Memory`], [`Error::BadImage`], also of a material with a required extension that is not known,
    /// [`Error::NotAMaterial`] without a material, [`Error::NoSuchExemplar`].
    pub(in crate::read) fn locate(path: &Path, options: &ReadOptions) -> Result<Self, Error> {
        let bytes = NamedFile::by_user(path).bytes()?;
        let mut file = GltfDocument::of(path, bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(&bytes))?;
        let index = match options.exemplar {
            Some(_) => options.exemplar_of(file.materials.len(), path)?,
            None => file.materials.iter().position(|one| !one.textures().is_empty()).unwrap_or(0),
        };
        let material = file.materials.get(index).ok_or_else(|| Error::NotAMaterial {
            path: path.to_owned(),
            expected: "a material in the glTF".to_owned(),
            found: "none".to_owned(),
            remedy: "export the model with its materials".to_owned(),
        })?;
        // The name, or else that of its file: materials of several files are compared.
        let stem = || path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        let name = material.name().map_or_else(stem, str::to_owned);
        let refused = |problem: String, remedy: &str| {
            Err(Error::BadImage { path: path.to_owned(), problem, remedy: remedy.to_owned() })
        };
        if let Some(problem) = features::transforms_differ(material) {
            return refused(problem, "bake the maps into one arrangement");
        }
        if let Some(extension) = features::unknown_required(&file, material) {
            let found = format!("found {extension}, which the file requires");
            let problem = format!("{name}: expected extensions that are read, {found}");
            return refused(problem, "export the material as metallic and roughness");
        }
        let mut textures = material.textures();
        textures.sort_by_key(|(_, role, _)| *role != Role::Normal);
        let picture = |(_, role, info): (&str, Role, &material::TextureInfo)| {
            let subject = Subject::Map(role);
            Ok(Picture { source: file.picture(info.index, subject)?, subject })
        };
        let names = file.materials.iter().map(|one| one.name().unwrap_or("unnamed").to_owned()).collect();
        Ok(Self {
            path: path.to_owned(),
            name,
            pictures: textures.into_iter().map(picture).collect::<Result<_, Error>>()?,
            buffers: file.files(),
            not_modelled: features::ignored(&file, index),
            materials: (names, index),
            material: file.materials.swap_remove(index),
        })
    }

    /// Every file that may be decoded.
    pub(in crate::read) fn files(&self) -> Vec<NamedFile> {
        let embedded = self.buffers.iter().cloned().chain([NamedFile::by_user(&self.path)]);
        self.pictures.iter().filter_map(|picture| picture.file().cloned()).chain(embedded).collect()
    }

    /// Reads its maps; each picture is one step of `progress`.
    ///
    /// # Errors
    /// [`Error::NotAMaterial`] without a map that is needed; those of its pictures.
    pub(in crate::read) fn read(
        self,
        options: &ReadOptions,
        progress: &Progress,
    ) -> Result<StoredMaterial, Error> {
        let read = decoded(&self.pictures, progress)?;
        let mut maps = MapsByRole::default();
        read.iter().for_each(|picture| maps.record_size(picture.map.raster.size()));
        let map = |role| {
            let picture = read.iter().find(|picture| picture.subject == Subject::Map(role))?;
            Some(picture.map.clone())
        };
        if let Some(normal) = map(Role::Normal) {
            maps.add(Role::Normal, normal.scaled_normals(self.material.normal_scale().into()));
        }
        let is_glossy = self.material.extensions.gloss.is_some();
        let textures = Textures {
            path: &self.path,
            colour: map(if is_glossy { Role::Diffuse } else { Role::Base }),
            packed: map(if is_glossy { Role::Specular } else { Role::Roughness }),
            specular: map(Role::SpecularLevel),
            specular_colour: map(Role::Specular),
        };
        let is_linear = textures.add_to(&mut maps, &self.material);
        let mut found = maps.material(&self.path, self.name, "", options)?;
        for file in self.buffers {
            let by = file.outside().map(Path::to_owned);
            found.notes.extend(by.map(|by| Note::OutsideFolder { file: file.path().to_owned(), by }));
            found.add_file(file.path().to_owned());
        }
        found.add_file(self.path);
        // The pictures of computed maps, too: no output may replace them.
        read.iter().for_each(|picture| found.add_file(picture.map.file.clone()));
        found.is_mapped = true;
        specify(&mut found, if is_glossy { Roughness::Gloss } else { Roughness::R }, is_linear);
        found.note_document(self.not_modelled, self.materials);
        // glTF specifies how colours are stored, whatever its pictures declare (glTF 2.0, 5.19).
        let is_of_colours =
            |note: &Note| matches!(note, Note::LinearChunk(..) | Note::Profile(_) | Note::PrimariesChunk(..));
        notice(&mut found, &read, |note| !is_of_colours(note));
        Ok(found)
    }
}

/// Records the encodings of the specification.
fn specify(found: &mut StoredMaterial, roughness: Roughness, is_linear: bool) {
    let why = "the specification of glTF 2.0 defines it";
    let albedo = if is_linear { Albedo::Linear } else { Albedo::Srgb };
    found.inferred = Inferences {
        normal_encoding: Some((NormalEncoding::Unsigned, Reason::stated(why), Certainty::Sure)),
        ..Inferences::stated(albedo, roughness, why)
    };
    let layout = Assumption::new(What::Layout, "glTF", Reason::LISTED, Certainty::Sure);
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
    fn add_to(&self, maps: &mut MapsByRole, material: &GltfMaterial) -> bool {
        let rgb = |factor: Option<[f32; 4]>| factor.map_or([1.0; 3], |[r, g, b, _]| [r, g, b]);
        if let Some(gloss) = &material.extensions.gloss {
            let specular = gloss.specular_factor.unwrap_or([1.0; 3]);
            maps.add(Role::Diffuse, self.colour(self.colour.clone(), rgb(gloss.diffuse_factor)));
            maps.add(Role::Specular, self.colour(self.packed.clone(), specular));
            maps.add(Role::Roughness, self.glossiness(gloss.glossiness_factor.unwrap_or(1.0)));
            return false;
        }
        let pbr = &material.pbr_metallic_roughness;
        let dielectric = self.dielectric(material);
        maps.add(Role::Roughness, self.channel(1, pbr.roughness_factor.unwrap_or(1.0)));
        let metallic = self.channel(2, pbr.metallic_factor.unwrap_or(1.0));
        self.add_reflectance(maps, rgb(pbr.base_color_factor), metallic, dielectric)
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
    fn dielectric(&self, material: &GltfMaterial) -> Field {
        let ior = material.extensions.ior.as_ref().and_then(|one| one.ior).unwrap_or(DEFAULT_IOR);
        let plain = Field::constant(&[reflectance(ior)]);
        let Some(specular) = &material.extensions.specular else { return plain };
        let strength = specular.specular_factor.unwrap_or(1.0);
        let colour = specular.specular_color_factor.unwrap_or([1.0; 3]);
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
