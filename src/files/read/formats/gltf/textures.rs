//! The pictures of a glTF: files beside it, parts of its buffers, data URIs.

use std::fs;
use std::path::{Path, PathBuf};

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use gltf::image::Source as Image;
use gltf::{Document, Texture};
use percent_encoding::percent_decode_str;

use super::document::bad;
use crate::error::Error;
use crate::files::read::decode;
use crate::files::read::note::Subject;
use crate::files::read::raster::Raster;
use crate::files::read::stored::StoredMap;

/// Extensions of a texture that name its picture, the one that is decoded to more exact values first.
const SOURCES: [&str; 4] = ["EXT_texture_webp", "MSFT_texture_dds", "KHR_texture_basisu", "EXT_texture_avif"];

/// The file and what it brings along.
pub(super) struct GltfFile {
    pub path: PathBuf,
    pub document: Document,
    pub blob: Option<Vec<u8>>,
}

impl GltfFile {
    /// The picture of a texture.
    ///
    /// # Errors
    /// The decoders' errors.
    pub(super) fn picture(&self, texture: &Texture<'_>, what: Subject) -> Result<StoredMap, Error> {
        let (raster, file, part) = match self.image(texture, what)?.source() {
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

    /// The image of a texture: the one that all programs read, else the one of an extension.
    fn image(&self, texture: &Texture<'_>, what: Subject) -> Result<gltf::Image<'_>, Error> {
        let image = |index: usize| self.document.images().nth(index);
        let of = |name: &str| image(texture.extension_value(name)?.get("source")?.as_u64()?.try_into().ok()?);
        let plain = texture.source().and_then(|plain| image(plain.index()));
        plain.or_else(|| SOURCES.iter().find_map(|name| of(name))).ok_or_else(|| {
            let names = texture.extensions().into_iter().flatten().map(|(name, _)| name.as_str());
            let names = names.collect::<Vec<_>>().join(", ");
            let found = if names.is_empty() { "none".to_owned() } else { format!("only {names}") };
            bad(&self.path, format!("{what}: expected a picture in its texture, found {found}"))
        })
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
        self.path.with_file_name(Path::new(percent_decode_str(uri).decode_utf8_lossy().as_ref()))
    }

    fn data(&self, uri: &str) -> Result<Vec<u8>, Error> {
        let encoded = uri.split_once("base64,").map(|(_, encoded)| encoded);
        let data = encoded.and_then(|encoded| STANDARD.decode(encoded).ok());
        data.ok_or_else(|| bad(&self.path, "expected a data URI in base64, found another".to_owned()))
    }
}
