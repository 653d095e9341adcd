//! Files of renderings: EXR of linear radiance in 32-bit floats and PNG of 8-bit sRGB, with their provenance: everything that makes them
//! again.

use std::io::{self, Seek, Write};
use std::path::Path;

use exr::image::pixel_vec::PixelVec;
use exr::prelude::{
    Encoding, Image as ExrImage, Layer, LayerAttributes, LineOrder, SpecificChannels, Text, WritableImage,
};

use svbrdf_core::image::Image;
use svbrdf_core::model::convention::Convention;
use svbrdf_core::picture::content::PictureContent;

use crate::disk::atomic;
use crate::error::Error;
use crate::session::Session;

/// The metadata of a picture: (keyword, text).
pub type Entries = [(&'static str, String)];

/// The content of a picture, and everything that makes it again.
#[derive(Clone, Debug)]
pub struct Provenance {
    pub content: PictureContent,
    pub convention: Convention,
    /// The names of the materials, from left to right; of differences the ground truth first.
    pub sources: Vec<String>,
    /// Its renderer: the CPU or the name of an adapter.
    pub renderer: String,
    /// The comparison, with the scene and the stops by which the renderings of a PNG are brightened; an EXR keeps the radiance as it is.
    pub session: Session,
}

impl Provenance {
    /// The program and its version.
    pub const SOFTWARE: &str = atomic::SOFTWARE;

    /// Everything but the program as (keyword, text) for the picture `path`, in a fixed order; `shows` takes the place of the text about
    /// its content.
    ///
    /// # Errors
    /// [`Error::Internal`].
    pub fn entries(&self, path: &Path, shows: Option<String>) -> Result<Vec<(&'static str, String)>, Error> {
        Ok(vec![
            ("svbrdf:shows", shows.unwrap_or_else(|| self.content.text(self.convention.epsilon))),
            ("svbrdf:sources", self.sources.join(" | ")),
            ("svbrdf:renderer", self.renderer.clone()),
            self.session.entry(path)?,
        ])
    }
}

/// Writes one layer of channels R, G and B.
///
/// Its provenance stands in the attribute `comments`, a line for each entry: custom attributes have no fixed order in
/// the library, and the same picture must be the same file.
pub(super) fn exr(file: impl Write + Seek, image: Image<f32>, entries: &Entries) -> io::Result<()> {
    let size = (image.width, image.height);
    let pixels: Vec<_> = image.pixels.into_iter().map(|[r, g, b]| (r, g, b)).collect();
    let channels = SpecificChannels::rgb(PixelVec::new(size, pixels));
    // In any other order, blocks stand as the threads finish them.
    let encoding = Encoding { line_order: LineOrder::Increasing, ..Encoding::FAST_LOSSLESS };
    let layer = Layer::new(size, attributes(entries), encoding, channels);
    ExrImage::from_layer(layer).write().to_buffered(file).map_err(io::Error::other)
}

fn attributes(entries: &Entries) -> LayerAttributes {
    let line = |(keyword, text): &(&str, String)| format!("{keyword}: {}\n", ascii(text));
    let comments: String = entries.iter().map(line).collect();
    LayerAttributes {
        software_name: Text::new_or_none(Provenance::SOFTWARE),
        comments: Text::new_or_none(comments),
        ..LayerAttributes::default()
    }
}

/// The text with every other character written as `\u{...}`: attributes hold one byte a character.
fn ascii(text: &str) -> String {
    let escaped = |c: char| if c.is_ascii() { c.to_string() } else { c.escape_unicode().to_string() };
    text.chars().map(escaped).collect()
}

pub(super) fn png(file: impl Write, image: &Image<u8>, entries: &Entries) -> io::Result<()> {
    let mut encoder = png::Encoder::new(file, side(image.width)?, side(image.height)?);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_source_srgb(png::SrgbRenderingIntent::RelativeColorimetric);
    encoder.add_text_chunk("Software".to_owned(), Provenance::SOFTWARE.to_owned())?;
    for (keyword, text) in entries {
        if text.is_ascii() {
            encoder.add_text_chunk((*keyword).to_owned(), text.clone())?;
        } else {
            encoder.add_itxt_chunk((*keyword).to_owned(), text.clone())?;
        }
    }
    let mut writer = encoder.write_header()?;
    writer.write_image_data(image.pixels.as_flattened())?;
    Ok(writer.finish()?)
}

fn side(length: usize) -> io::Result<u32> {
    u32::try_from(length).map_err(io::Error::other)
}

/// The compressed data of a PNG: what its `IDAT` chunks hold.
pub(super) fn compressed(file: &[u8]) -> Vec<u8> {
    const SIGNATURE: usize = 8;
    let mut data = Vec::new();
    let mut rest = file.get(SIGNATURE..).unwrap_or_default();
    while let Some(([a, b, c, d], after)) = rest.split_first_chunk() {
        let length = u32::from_be_bytes([*a, *b, *c, *d]) as usize;
        let (Some(name), Some(content)) = (after.get(..4), after.get(4..4 + length)) else { break };
        if name == b"IDAT" {
            data.extend_from_slice(content);
        }
        // A checksum of 4 bytes ends a chunk.
        rest = after.get(8 + length..).unwrap_or_default();
    }
    data
}

#[cfg(test)]
mod tests {
    use std::io::Cursor;

    use super::*;

    #[test]
    fn a_large_picture_has_the_same_bytes_every_time() {
        let written = || {
            let pixels = (0..256 * 256).map(|i| [(i % 7) as f32, (i % 31) as f32, 0.5]).collect();
            let mut bytes = Cursor::new(Vec::new());
            exr(&mut bytes, Image { width: 256, height: 256, pixels }, &[]).unwrap();
            bytes.into_inner()
        };
        let first = written();
        assert!((0..30).all(|_| written() == first), "the order of blocks differs");
    }
}
