//! EXR files of linear radiance, in 32-bit floats.

use std::io::{self, Seek, Write};

use exr::image::pixel_vec::PixelVec;
use exr::prelude::{
    Encoding, Image as ExrImage, Layer, LayerAttributes, LineOrder, SpecificChannels, Text, WritableImage,
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

#[cfg(test)]
mod tests {
    use std::io::Cursor;

    use super::*;

    #[test]
    fn a_large_picture_has_the_same_bytes_every_time() {
        let written = || {
            let pixels = (0..256 * 256).map(|i| [(i % 7) as f32, (i % 31) as f32, 0.5]).collect();
            let mut bytes = Cursor::new(Vec::new());
            write(&mut bytes, Image { width: 256, height: 256, pixels }, &[]).unwrap();
            bytes.into_inner()
        };
        let first = written();
        assert!((0..30).all(|_| written() == first), "the order of blocks differs");
    }
}
