//! EXR files of linear radiance, in 32-bit floats.

use std::io::{self, Seek, Write};

use exr::image::pixel_vec::PixelVec;
use exr::prelude::{
    Encoding, Image as ExrImage, Layer, LayerAttributes, SpecificChannels, Text, WritableImage,
};

use svbrdf_core::image::Image;

use super::provenance::{Entries, Provenance};

/// Writes one layer of channels R, G and B.
///
/// Its provenance stands in the attribute `comments`, a line for each entry: custom attributes have no fixed order in
/// the library, and the same picture must be the same file.
pub(super) fn write(file: impl Write + Seek, image: Image<f32>, entries: &Entries) -> io::Result<()> {
    let size = (image.width, image.height);
    let pixels: Vec<_> = image.pixels.into_iter().map(|[r, g, b]| (r, g, b)).collect();
    let channels = SpecificChannels::rgb(PixelVec::new(size, pixels));
    let layer = Layer::new(size, attributes(entries), Encoding::FAST_LOSSLESS, channels);
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
