//! Materials of glTF 2.0, through the `gltf` library: files beside it, pictures within it, factors.

use std::fs;
use std::path::{Path, PathBuf};

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use gltf::image::Source as Image;
use gltf::{Document, Gltf, Texture};

use super::assumption::{Assumption, Certainty, What};
use super::decode;
use super::found::{Found, Pictures, Source};
use super::names::Role;
use super::options::{Albedo, NormalY, ReadOptions, Roughness};
use super::raster::{Raster, Samples};
use crate::error::Error;
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
pub fn open(path: &Path, options: &ReadOptions, progress: &Progress) -> Result<Found, Error> {
    let bytes = fs::read(path).map_err(|source| Error::unreadable(path, source))?;
    let gltf = Gltf::from_slice(&bytes).map_err(|e| bad(path, format!("expected valid glTF, found: {e}")))?;
    // The library panics at images that lead nowhere.
    let leads = |i: &gltf::json::Image| i.uri.is_some() || (i.buffer_view.is_some() && i.mime_type.is_some());
    if !gltf.document.as_json().images.iter().all(leads) {
        return Err(bad(path, "expected images with a uri, or a bufferView and a mimeType".to_owned()));
    }
    let scene = Scene { path: path.to_owned(), document: gltf.document, blob: gltf.blob };
    let count = scene.document.materials().len();
    let index = options.exemplar.min(count.saturating_sub(1));
    let material = scene.document.materials().nth(index).ok_or_else(|| Error::NotAMaterial {
        path: path.to_owned(),
        expected: "a material in the glTF".to_owned(),
        found: "none".to_owned(),
        remedy: "export the model with its materials".to_owned(),
    })?;
    let pbr = material.pbr_metallic_roughness();
    progress.begin(3);
    let load = |texture: Option<Texture<'_>>, what: &str| -> Result<Option<Source>, Error> {
        let source = texture.map(|texture| scene.picture(&texture, what)).transpose()?;
        progress.step().map(|()| source)
    };
    let colour = load(pbr.base_color_texture().map(|t| t.texture()), "base colour map")?;
    let orm = load(pbr.metallic_roughness_texture().map(|t| t.texture()), "roughness and metallic map")?;
    let normal = load(material.normal_texture().map(|t| t.texture()), "normal map")?;
    if colour.is_none() && orm.is_none() && normal.is_none() {
        return Err(Error::NotAMaterial {
            path: path.to_owned(),
            expected: "a material with textures".to_owned(),
            found: format!("material {index} of {count} without one"),
            remedy: "choose another with --exemplar".to_owned(),
        });
    }
    let channel = |number: usize, factor: f32| match &orm {
        Some(orm) => Source { raster: scaled(orm.raster.channel(number), &[factor]), ..orm.clone() },
        None => scene.constant(&[factor]),
    };
    let [r, g, b, _] = pbr.base_color_factor();
    let mut pictures = Pictures::default();
    pictures.add(Role::Roughness, channel(1, pbr.roughness_factor()));
    pictures.add(Role::Metallic, channel(2, pbr.metallic_factor()));
    // A factor is linear and the picture is not: see `base`.
    pictures
        .add(Role::Base, colour.map_or_else(|| scene.constant(&[r, g, b].map(srgb)), |c| base(c, [r, g, b])));
    if let Some(normal) = normal {
        pictures.add(Role::Normal, normal);
    }
    let name = material.name().map_or_else(|| format!("material {index}"), str::to_owned);
    let mut found = pictures.into_found(path, name, "")?;
    found.files.push(path.to_owned());
    found.files.sort();
    found.files.dedup();
    specify(&mut found);
    if count > 1 {
        let line =
            format!("The glTF holds {count} materials; this is number {index} from 0. Another: --exemplar.");
        found.notes.push(line);
    }
    Ok(found)
}

/// What the specification of glTF 2.0 says.
fn specify(found: &mut Found) {
    let why = || "glTF 2.0 is so by its specification".to_owned();
    found.hints.albedo = Some((Albedo::Srgb, why(), Certainty::Sure));
    found.hints.roughness = Some((Roughness::R, why(), Certainty::Sure));
    found.hints.normal_y = Some((NormalY::Up, why(), Certainty::Sure));
    found
        .assumptions
        .insert(0, Assumption::new(What::Layout, "glTF", "the file names its textures", Certainty::Sure));
}

fn bad(path: &Path, problem: String) -> Error {
    Error::BadImage { path: path.to_owned(), problem, remedy: "export it again".to_owned() }
}

impl Scene {
    /// The picture of a texture.
    fn picture(&self, texture: &Texture<'_>, what: &str) -> Result<Source, Error> {
        let (raster, file, part) = match texture.source().source() {
            Image::Uri { uri, .. } if uri.starts_with("data:") => {
                (self.decoded(&self.data(uri)?, what)?, self.path.clone(), what.to_owned())
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
                (self.decoded(bytes, what)?, self.path.clone(), what.to_owned())
            }
        };
        Ok(Source { raster, file, part })
    }

    fn decoded(&self, bytes: &[u8], what: &str) -> Result<Raster, Error> {
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

    /// A map of one value: a factor without a texture.
    fn constant(&self, values: &[f32]) -> Source {
        let channels = values.iter().map(|&value| Samples::Floats(vec![value])).collect();
        let raster = Raster { width: 1, height: 1, depth: "factor", channels, alpha: None };
        Source { raster, file: self.path.clone(), part: "factor".to_owned() }
    }
}

/// The picture times a factor for each channel; as it is where all are 1.
fn scaled(raster: Raster, factors: &[f32]) -> Raster {
    if factors.iter().all(|&factor| factor == 1.0) {
        return raster;
    }
    let times = |(plane, &factor): (&Samples, &f32)| {
        Samples::Floats((0..plane.len()).map(|i| plane.at(i) as f32 * factor).collect())
    };
    Raster { channels: raster.channels.iter().zip(factors.iter().cycle()).map(times).collect(), ..raster }
}

/// The sRGB picture of a base colour times a linear factor, in sRGB.
fn base(source: Source, factor: [f32; 3]) -> Source {
    if factor == [1.0; 3] {
        return source;
    }
    let linear = |v: f32| if v <= 0.040_45 { v / 12.92 } else { ((v + 0.055) / 1.055).powf(2.4) };
    let last = source.raster.channels.len() - 1;
    let times = |c: usize| {
        let plane = &source.raster.channels[last.min(c)];
        Samples::Floats((0..plane.len()).map(|i| srgb(linear(plane.at(i) as f32) * factor[c])).collect())
    };
    let channels = [0, 1, 2].map(times).into();
    Source { raster: Raster { channels, ..source.raster }, ..source }
}

fn srgb(value: f32) -> f32 {
    if value <= 0.003_130_8 { 12.92 * value } else { 1.055 * value.powf(1.0 / 2.4) - 0.055 }
}
