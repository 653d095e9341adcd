//! Textures of a glTF: files beside it, parts of its buffers, data URIs.

use std::borrow::Cow;
use std::path::PathBuf;

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use gltf::image::Source as Image;
use gltf::json::Value;
use gltf::{Document, Texture};
use percent_encoding::percent_decode_str;

use super::document::bad;
use crate::disk::open::NamedFile;
use crate::error::Error;
use crate::read::located::picture::PictureSource;
use crate::read::record::Subject;

/// Extensions of a texture that name its picture, the one that is decoded to more exact values first.
pub(super) const SOURCES: [&str; 3] = ["EXT_texture_webp", "MSFT_texture_dds", "EXT_texture_avif"];

/// A glTF and its binary part.
pub(super) struct GltfFile {
    pub path: PathBuf,
    pub document: Document,
    /// The document but for pictures and buffers, as the file declares it.
    pub declared: Value,
    pub blob: Option<Vec<u8>>,
}

impl GltfFile {
    /// The picture of a texture, to be read as `what`.
    ///
    /// # Errors
    /// [`Error::BadImage`] where the texture has no picture, [`Error::Unreadable`] where a buffer cannot be read.
    pub(super) fn picture(&self, texture: &Texture<'_>, what: Subject) -> Result<PictureSource, Error> {
        let bytes = match self.image(texture, what)?.source() {
            Image::Uri { uri, .. } if uri.starts_with("data:") => self.data(uri)?,
            Image::Uri { uri, .. } => return Ok(PictureSource::File(self.beside(uri))),
            Image::View { view, .. } => {
                let out_of_range = || bad(&self.path, format!("{what}: expected it within its buffer"));
                self.view(&view)?.ok_or_else(out_of_range)?
            }
        };
        Ok(PictureSource::Embedded { within: self.path.clone(), bytes })
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

    /// The bytes of a view of a buffer; `None` where the buffer is shorter.
    ///
    /// # Errors
    /// [`Error::BadImage`], [`Error::Unreadable`] where the buffer cannot be read.
    pub(super) fn view(&self, view: &gltf::buffer::View<'_>) -> Result<Option<Vec<u8>>, Error> {
        let buffer = self.buffer(&view.buffer())?;
        let end = view.offset().checked_add(view.length());
        Ok(end.and_then(|end| buffer.get(view.offset()..end)).map(<[u8]>::to_owned))
    }

    fn buffer(&self, buffer: &gltf::Buffer<'_>) -> Result<Cow<'_, [u8]>, Error> {
        match buffer.source() {
            gltf::buffer::Source::Bin => self
                .blob
                .as_deref()
                .map(Cow::Borrowed)
                .ok_or_else(|| bad(&self.path, "expected the binary part, found none".to_owned())),
            gltf::buffer::Source::Uri(uri) if uri.starts_with("data:") => self.data(uri).map(Cow::Owned),
            gltf::buffer::Source::Uri(uri) => self.beside(uri).bytes().map(Cow::Owned),
        }
    }

    /// The files of the buffers, as far as they are there.
    pub(super) fn buffers(&self) -> Vec<NamedFile> {
        let file = |buffer: gltf::Buffer<'_>| match buffer.source() {
            gltf::buffer::Source::Uri(uri) if !uri.starts_with("data:") => Some(self.beside(uri)),
            _ => None,
        };
        self.document.buffers().filter_map(file).filter(NamedFile::exists).collect()
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
