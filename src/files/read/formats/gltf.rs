//! Materials of glTF 2.0, through the `gltf` library: files beside it, pictures within it, factors.

use std::fs;
use std::path::{Path, PathBuf};

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use gltf::image::Source as Image;
use gltf::material::{PbrMetallicRoughness, PbrSpecularGlossiness};
use gltf::{Document, Gltf, Texture};

use crate::error::Error;
use crate::files::read::assumption::{Assumption, Certainty, What};
use crate::files::read::decode;
use crate::files::read::decode::panic_guard::catch_panic;
use crate::files::read::locate::names::Role;
use crate::files::read::note::{Container, Note, Subject};
use crate::files::read::options::{Albedo, NormalY, ReadOptions, Roughness};
use crate::files::read::raster::Raster;
use crate::files::read::storage_convention::StorageConvention;
use crate::files::read::stored::{Pictures, StoredMap, StoredMaterial};
use crate::progress::Progress;

/// The file and what it brings along.
struct Scene {
    path: PathBuf,
    document: Document,
    blob: Option<Vec<u8>>,
}

/// Reads material number `exemplar` of the file `path`.
///
/// # Errors
/// As `read`.
pub fn open(path: &Path, options: &ReadOptions, progress: &Progress) -> Result<StoredMaterial, Error> {
    let bytes = fs::read(path).map_err(|source| Error::unreadable(path, source))?;
    let invalid = |found: &str| bad(path, format!("expected valid glTF, found: {found}"));
    // The library panics at some lengths that a damaged glb claims.
    let gltf = catch_panic(|| Gltf::from_slice(&bytes))
        .map_err(|_| invalid("a contradiction in its lengths"))?
        .map_err(|e| invalid(&e.to_string()))?;
    // The library panics at images that lead nowhere.
    let leads = |i: &gltf::json::Image| i.uri.is_some() || (i.buffer_view.is_some() && i.mime_type.is_some());
    if !gltf.document.as_json().images.iter().all(leads) {
        return Err(bad(path, "expected images with a uri, or a bufferView and a mimeType".to_owned()));
    }
    let scene = Scene { path: path.to_owned(), document: gltf.document, blob: gltf.blob };
    let count = scene.document.materials().len();
    let index = options.exemplar_of(count, path)?;
    let material = scene.document.materials().nth(index).ok_or_else(|| Error::NotAMaterial {
        path: path.to_owned(),
        expected: "a material in the glTF".to_owned(),
        found: "none".to_owned(),
        remedy: "export the model with its materials".to_owned(),
    })?;
    progress.begin(3);
    let mut pictures = Pictures::default();
    let normal = scene.load(material.normal_texture().map(|t| t.texture()), Role::Normal, progress)?;
    let textured = match material.pbr_specular_glossiness() {
        Some(spec_gloss) => scene.specular_glossiness(&spec_gloss, &mut pictures, progress)?,
        None => scene.metallic_roughness(&material.pbr_metallic_roughness(), &mut pictures, progress)?,
    };
    if !textured && normal.is_none() {
        return Err(Error::NoTextures {
            path: path.to_owned(),
            name: material.name().unwrap_or("the material").to_owned(),
            exemplar: index,
            count,
        });
    }
    if let Some(normal) = normal {
        pictures.add(Role::Normal, normal);
    }
    let name = material.name().map_or_else(|| format!("material {index}"), str::to_owned);
    let mut found = pictures.assemble(path, name, "", options)?;
    found.files.push(path.to_owned());
    found.files.sort();
    found.files.dedup();
    let gloss = material.pbr_specular_glossiness().is_some();
    specify(&mut found, if gloss { Roughness::Gloss } else { Roughness::R });
    if count > 1 {
        found.notes.push(Note::Several { container: Container::Gltf, count, index });
    }
    Ok(found)
}

/// What the specification of glTF 2.0 says.
fn specify(found: &mut StoredMaterial, roughness: Roughness) {
    let why = || StorageConvention::Gltf.into();
    found.inferred.albedo = Some((Albedo::Srgb, why(), Certainty::Sure));
    found.inferred.specular = found.inferred.albedo.clone();
    found.inferred.roughness = Some((roughness, why(), Certainty::Sure));
    found.inferred.normal_y = Some((NormalY::Up, why(), Certainty::Sure));
    found
        .assumptions
        .insert(0, Assumption::new(What::Layout, "glTF", StorageConvention::ListedTextures, Certainty::Sure));
}

fn bad(path: &Path, problem: String) -> Error {
    Error::BadImage { path: path.to_owned(), problem, remedy: "export it again".to_owned() }
}

impl Scene {
    fn load(
        &self,
        texture: Option<Texture<'_>>,
        map: Role,
        progress: &Progress,
    ) -> Result<Option<StoredMap>, Error> {
        let source = texture.map(|texture| self.picture(&texture, Subject::Map(map))).transpose()?;
        progress.step().map(|()| source)
    }

    /// Base colour, roughness and metallic; whether there is any texture.
    fn metallic_roughness(
        &self,
        pbr: &PbrMetallicRoughness<'_>,
        pictures: &mut Pictures,
        progress: &Progress,
    ) -> Result<bool, Error> {
        let colour = self.load(pbr.base_color_texture().map(|t| t.texture()), Role::Base, progress)?;
        let orm = pbr.metallic_roughness_texture().map(|t| t.texture());
        let orm = self.load(orm, Role::OcclusionRoughnessMetallic, progress)?;
        let textured = colour.is_some() || orm.is_some();
        let channel = |number: usize, factor: f32| match &orm {
            Some(orm) => StoredMap { raster: orm.raster.channel(number).scaled(&[factor]), ..orm.clone() },
            None => StoredMap::constant(&self.path, &[factor]),
        };
        let [r, g, b, _] = pbr.base_color_factor();
        pictures.add(Role::Roughness, channel(1, pbr.roughness_factor()));
        pictures.add(Role::Metallic, channel(2, pbr.metallic_factor()));
        pictures.add(Role::Base, self.colour(colour, [r, g, b]));
        Ok(textured)
    }

    /// Diffuse, specular and glossiness of the extension `KHR_materials_pbrSpecularGlossiness`.
    fn specular_glossiness(
        &self,
        pbr: &PbrSpecularGlossiness<'_>,
        pictures: &mut Pictures,
        progress: &Progress,
    ) -> Result<bool, Error> {
        let diffuse = self.load(pbr.diffuse_texture().map(|t| t.texture()), Role::Diffuse, progress)?;
        let both = pbr.specular_glossiness_texture().map(|t| t.texture());
        let both = self.load(both, Role::Specular, progress)?;
        let textured = diffuse.is_some() || both.is_some();
        let factor = pbr.glossiness_factor();
        let gloss = match &both {
            // Alpha that is 1 everywhere is not kept.
            Some(StoredMap { raster, .. }) => match raster.alpha.clone() {
                Some(alpha) => raster.of(alpha).scaled(&[factor]),
                None => Raster::constant("alpha", &[factor]),
            },
            None => Raster::constant("factor", &[factor]),
        };
        let file = both.as_ref().map_or(&self.path, |source| &source.file).clone();
        let [r, g, b, _] = pbr.diffuse_factor();
        pictures.add(Role::Diffuse, self.colour(diffuse, [r, g, b]));
        pictures.add(Role::Specular, self.colour(both, pbr.specular_factor()));
        pictures.add(Role::Roughness, StoredMap { raster: gloss, file, part: "alpha".to_owned() });
        Ok(textured)
    }

    /// The sRGB picture of a colour times a linear factor, in sRGB.
    fn colour(&self, source: Option<StoredMap>, factor: [f32; 3]) -> StoredMap {
        source.unwrap_or_else(|| StoredMap::constant(&self.path, &[1.0; 3])).times(factor, Albedo::Srgb)
    }

    /// The picture of a texture.
    fn picture(&self, texture: &Texture<'_>, what: Subject) -> Result<StoredMap, Error> {
        let (raster, file, part) = match texture.source().source() {
            Image::Uri { uri, .. } if uri.starts_with("data:") => {
                (self.decoded(&self.data(uri)?, what)?, self.path.clone(), what.to_string())
            }
            Image::Uri { uri, .. } => {
                let file = self.beside(uri);
                (decode::decode_one(&file, what)?.0, file, String::new())
            }
            Image::View { view, .. } => {
                let buffer = self.buffer(&view.buffer())?;
                let end = view.offset().checked_add(view.length());
                let bytes = end.and_then(|end| buffer.get(view.offset()..end));
                let bytes =
                    bytes.ok_or_else(|| bad(&self.path, format!("{what}: expected it within its buffer")))?;
                (self.decoded(bytes, what)?, self.path.clone(), what.to_string())
            }
        };
        Ok(StoredMap { raster, file, part })
    }

    fn decoded(&self, bytes: &[u8], what: Subject) -> Result<Raster, Error> {
        let decoded = decode::decode(std::io::Cursor::new(bytes), &self.path, what)?;
        let first = decoded.layers.into_iter().next();
        first
            .map(|l| l.raster)
            .ok_or_else(|| bad(&self.path, format!("{what}: expected a picture, found none")))
    }

    fn buffer(&self, buffer: &gltf::Buffer<'_>) -> Result<Vec<u8>, Error> {
        match buffer.source() {
            gltf::buffer::Source::Bin => self
                .blob
                .clone()
                .ok_or_else(|| bad(&self.path, "expected the binary part, found none".to_owned())),
            gltf::buffer::Source::Uri(uri) if uri.starts_with("data:") => self.data(uri),
            gltf::buffer::Source::Uri(uri) => {
                let file = self.beside(uri);
                fs::read(&file).map_err(|source| Error::unreadable(&file, source))
            }
        }
    }

    /// A file by the URI that names it, `%20` and the like resolved.
    fn beside(&self, uri: &str) -> PathBuf {
        let mut bytes = Vec::new();
        let mut rest = uri.as_bytes();
        while let Some((&first, after)) = rest.split_first() {
            let code = (first == b'%').then(|| after.get(..2).and_then(|hex| std::str::from_utf8(hex).ok()));
            match code.flatten().and_then(|hex| u8::from_str_radix(hex, 16).ok()) {
                Some(byte) => {
                    bytes.push(byte);
                    rest = &after[2..];
                }
                None => {
                    bytes.push(first);
                    rest = after;
                }
            }
        }
        self.path.with_file_name(String::from_utf8_lossy(&bytes).as_ref())
    }

    fn data(&self, uri: &str) -> Result<Vec<u8>, Error> {
        let encoded = uri.split_once("base64,").map(|(_, encoded)| encoded);
        let data = encoded.and_then(|encoded| STANDARD.decode(encoded).ok());
        data.ok_or_else(|| bad(&self.path, "expected a data URI in base64, found another".to_owned()))
    }
}
