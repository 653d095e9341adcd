//! PNG files: 8-bit sRGB pictures with text chunks.

use std::io::{self, Write};

use svbrdf_core::image::Image;

use super::provenance::{Entries, Provenance};

pub(super) fn write(file: impl Write, image: &Image<u8>, entries: &Entries) -> io::Result<()> {
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
