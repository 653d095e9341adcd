//! The document of a glTF as far as materials need it: meshes, animations and all else may be damaged or unknown.

use std::borrow::Cow;
use std::path::{Path, PathBuf};

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use percent_encoding::percent_decode_str;
use serde::Deserialize;
use serde::de::DeserializeOwned;
use serde_json::{Map, Value};

use super::material::GltfMaterial;
use crate::disk::memory::{self, Reserved};
use crate::disk::open::NamedFile;
use crate::disk::refuse_pointer;
use crate::error::Error;
use crate::read::record::Subject;
use crate::read::stored::PictureSource;

/// Extensions of a texture that name its picture, the one that is decoded to more exact values first.
pub(super) const SOURCES: [&str; 3] = ["EXT_texture_webp", "MSFT_texture_dds", "EXT_texture_avif"];

/// A glTF and its binary part.
pub(super) struct GltfDocument {
    path: PathBuf,
    pub materials: Vec<GltfMaterial>,
    textures: Vec<Texture>,
    images: Vec<Image>,
    views: Vec<View>,
    buffers: Vec<Buffer>,
    /// All else, as the file declares it.
    declared: Value,
    blob: Option<Vec<u8>>,
    _memory: Reserved,
}

#[derive(Default, Deserialize)]
#[serde(default)]
struct Texture {
    source: Option<usize>,
    extensions: Map<String, Value>,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
struct Image {
    uri: Option<String>,
    buffer_view: Option<usize>,
    mime_type: Option<String>,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
struct View {
    buffer: usize,
    #[serde(default)]
    byte_offset: usize,
    byte_length: usize,
}

#[derive(Deserialize)]
struct Buffer {
    uri: Option<String>,
}

#[derive(Deserialize)]
struct Asset {
    version: String,
}

impl GltfDocument {
    /// The document of the file `path`, whose bytes these are.
    ///
    /// # Errors
    /// [`Error::BadImage`]; [`Error::Memory`].
    pub(super) fn of(path: &Path, bytes: &[u8]) -> Result<Self, Error> {
        refuse_pointer(path, bytes)?;
        let invalid = |found: &str| bad(path, format!("expected valid glTF, found: {found}"));
        let (json, blob) = match bytes.starts_with(b"glTF") {
            true => parts(bytes).ok_or_else(|| invalid("a contradiction in its lengths"))?,
            false => (bytes, None),
        };
        let memory = memory::reserve(bytes_of(json), || format!("the document of {}", path.display()))?;
        let of_json = |error: serde_json::Error| invalid(&error.to_string());
        let declared: Value = serde_json::from_slice(json).map_err(of_json)?;
        let Value::Object(mut all) = declared else { return Err(invalid("no object")) };
        let Asset { version } =
            Asset::deserialize(all.get("asset").unwrap_or(&Value::Null)).map_err(of_json)?;
        if !version.starts_with("2.") {
            return Err(bad(path, format!("expected glTF 2.0, found version {version}")));
        }
        let images: Vec<Image> = part(&mut all, "images").map_err(of_json)?;
        let leads = |i: &Image| i.uri.is_some() || (i.buffer_view.is_some() && i.mime_type.is_some());
        if !images.iter().all(leads) {
            return Err(bad(path, "expected images with a uri, or a bufferView and a mimeType".to_owned()));
        }
        Ok(Self {
            path: path.to_owned(),
            materials: part(&mut all, "materials").map_err(of_json)?,
            textures: part(&mut all, "textures").map_err(of_json)?,
            images,
            views: part(&mut all, "bufferViews").map_err(of_json)?,
            buffers: part(&mut all, "buffers").map_err(of_json)?,
            declared: all.into(),
            blob: blob.map(<[u8]>::to_owned),
            _memory: memory,
        })
    }

    /// The array of this name, as the file declares it; empty where there is none.
    pub(super) fn array(&self, name: &str) -> &[Value] {
        array(&self.declared, name)
    }

    pub(super) fn extensions_of(&self, texture: usize) -> Option<&Map<String, Value>> {
        Some(&self.textures.get(texture)?.extensions)
    }

    /// The picture of a texture, to be read as `what`.
    ///
    /// # Errors
    /// [`Error::BadImage`] where the texture has no picture, [`Error::Unreadable`] where a buffer cannot be read.
    pub(super) fn picture(&self, texture: usize, what: Subject) -> Result<PictureSource, Error> {
        let within = |place: &str| bad(&self.path, format!("{what}: expected it within its {place}"));
        let image = self.image(texture, what)?;
        let bytes = match (&image.uri, image.buffer_view) {
            (Some(uri), _) if uri.starts_with("data:") => self.data(uri)?,
            (Some(uri), _) => return Ok(PictureSource::File(self.beside(uri))),
            (None, view) => {
                let view = view.and_then(|view| self.views.get(view)).ok_or_else(|| within("file"))?;
                self.bytes(view)?.ok_or_else(|| within("buffer"))?
            }
        };
        Ok(PictureSource::Embedded { within: self.path.clone(), bytes })
    }

    /// The image of a texture: the one that all programs read, else the one of an extension.
    fn image(&self, texture: usize, what: Subject) -> Result<&Image, Error> {
        let missing = |found: String| {
            bad(&self.path, format!("{what}: expected a picture in its texture, found {found}"))
        };
        let texture = self.textures.get(texture).ok_or_else(|| missing("no such texture".to_owned()))?;
        let image = |index: usize| self.images.get(index);
        let of =
            |name: &&str| image(texture.extensions.get(*name)?.get("source")?.as_u64()?.try_into().ok()?);
        texture.source.and_then(image).or_else(|| SOURCES.iter().find_map(of)).ok_or_else(|| {
            let names = texture.extensions.keys().map(String::as_str).collect::<Vec<_>>().join(", ");
            missing(if names.is_empty() { "none".to_owned() } else { format!("only {names}") })
        })
    }

    /// The bytes of a view of a buffer; `None` where the buffer is shorter, or not there.
    fn bytes(&self, view: &View) -> Result<Option<Vec<u8>>, Error> {
        let Some(buffer) = self.buffers.get(view.buffer) else { return Ok(None) };
        let buffer = match &buffer.uri {
            Some(uri) if uri.starts_with("data:") => Cow::Owned(self.data(uri)?),
            Some(uri) => Cow::Owned(self.beside(uri).bytes()?),
            None => Cow::Borrowed(
                self.blob
                    .as_deref()
                    .ok_or_else(|| bad(&self.path, "expected the binary part, found none".to_owned()))?,
            ),
        };
        let end = view.byte_offset.checked_add(view.byte_length);
        Ok(end.and_then(|end| buffer.get(view.byte_offset..end)).map(<[u8]>::to_owned))
    }

    /// The files of the buffers, as far as they are there.
    pub(super) fn files(&self) -> Vec<NamedFile> {
        let uris = self.buffers.iter().filter_map(|buffer| buffer.uri.as_ref());
        let files = uris.filter(|uri| !uri.starts_with("data:")).map(|uri| self.beside(uri));
        files.filter(NamedFile::exists).collect()
    }

    /// A file by the URI that names it, `%20` and the like resolved.
    fn beside(&self, uri: &str) -> NamedFile {
        let name = percent_decode_str(uri).decode_utf8_lossy();
        NamedFile::within(name.as_ref(), &self.path)
    }

    fn data(&self, uri: &str) -> Result<Vec<u8>, Error> {
        let encoded = uri.split_once("base64,").map(|(_, encoded)| encoded);
        let data = encoded.and_then(|encoded| STANDARD.decode(encoded).ok());
        data.ok_or_else(|| bad(&self.path, "expected a data URI in base64, found another".to_owned()))
    }
}

/// The JSON and the binary part of a glb of version 2.
fn parts(bytes: &[u8]) -> Option<(&[u8], Option<&[u8]>)> {
    let (head, mut rest) = bytes.split_at_checked(12)?;
    let [_, version, length] = head.as_chunks::<4>().0 else { return None };
    let length = (u32::from_le_bytes(*length) as usize).checked_sub(head.len())?;
    if u32::from_le_bytes(*version) != 2 || length > rest.len() {
        return None;
    }
    let json = chunk(&mut rest, b"JSON")?;
    let blob = if rest.is_empty() { None } else { Some(chunk(&mut rest, b"BIN\0")?) };
    Some((json, blob))
}

/// Takes the chunk of this kind from the beginning of `rest`.
fn chunk<'a>(rest: &mut &'a [u8], kind: &[u8; 4]) -> Option<&'a [u8]> {
    let (length, after) = rest.split_first_chunk::<4>()?;
    let after = after.strip_prefix(kind)?;
    let (chunk, after) = after.split_at_checked(u32::from_le_bytes(*length) as usize)?;
    *rest = after;
    Some(chunk)
}

/// Takes a part out of a document.
fn part<T: DeserializeOwned>(all: &mut Map<String, Value>, name: &str) -> Result<Vec<T>, serde_json::Error> {
    all.remove(name).map_or(Ok(Vec::new()), serde_json::from_value)
}

/// The memory that a document takes at most: as JSON, and as the objects that are read of it.
fn bytes_of(json: &[u8]) -> u64 {
    /// An object in bytes: a node of each map, and the largest object that is read.
    const OBJECT: u64 = 1280 + size_of::<GltfMaterial>() as u64;
    /// A value of an array or a map, with room to grow, in bytes.
    const VALUE: u64 = 128;
    let count = |searched: u8| json.iter().filter(|byte| **byte == searched).count() as u64;
    4 * json.len() as u64 + OBJECT * count(b'{') + VALUE * (count(b',') + count(b'['))
}

/// The array of this name in a value; empty where there is none.
pub(super) fn array<'a>(value: &'a Value, name: &str) -> &'a [Value] {
    value.get(name).and_then(Value::as_array).map_or(&[], Vec::as_slice)
}

pub(super) fn bad(path: &Path, problem: String) -> Error {
    Error::BadImage { path: path.to_owned(), problem, remedy: "export it again".to_owned() }
}
