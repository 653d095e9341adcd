//! TIFF through the `tiff` library: integers of 8, 16 and 32 bits, half, float and double, in pixels or planes.

use tiff::ColorType;
use tiff::TiffUnsupportedError as Unsupported;
use tiff::decoder::{Decoder, DecodingResult, Limits};
use tiff::tags::Tag;

use super::place::{Decoded, DecodedFile, MAX_BYTES, alone, ratio};
use super::reader::Reader;
use super::tiff_jpeg;
use crate::error::Error;
use crate::read::raster::{Buffer, Raster, Samples};
use crate::read::record::Note;

pub(crate) fn decode(reader: Reader<'_>, place: DecodedFile<'_>) -> Result<Decoded, Error> {
    let invalid = |error: tiff::TiffError| match error {
        tiff::TiffError::IoError(io) if io.kind() == std::io::ErrorKind::UnexpectedEof => place.truncated(),
        tiff::TiffError::UnsupportedError(Unsupported::UnsupportedCompressionMethod(method)) => {
            let name = compression(method.to_u16()).map_or_else(|| format!("{method:?}"), str::to_owned);
            place.bad(
                format!("expected a compression that is read, found a TIFF in {name}"),
                "save it with LZW or Deflate",
            )
        }
        tiff::TiffError::UnsupportedError(what) => {
            place.bad(format!("expected gray or RGB, found a TIFF in which {what}"), "convert it to RGB")
        }
        other => place.invalid("TIFF", other),
    };
    let mut limits = Limits::default();
    limits.decoding_buffer_size = usize::try_from(MAX_BYTES).unwrap_or(usize::MAX);
    limits.intermediate_buffer_size = limits.decoding_buffer_size;
    let mut decoder = Decoder::new(reader).map_err(invalid)?.with_limits(limits);
    let (width, height) = decoder.dimensions().map_err(invalid)?;
    let colour = decoder.colortype().map_err(invalid)?;
    // Of fewer, several samples are in a byte, of which a column of texels has one each.
    if colour.bit_depth() < 8 {
        let problem =
            format!("expected 8 bits a sample or more, found a TIFF with a depth of {}", colour.bit_depth());
        return Err(place.bad(problem, "save it with 8 bits"));
    }
    let count = channels_of(colour)
        .ok_or_else(|| place.bad(format!("expected gray or RGB, found {colour:?}"), "convert it to RGB"))?;
    let bytes =
        u64::from(width) * u64::from(height) * count as u64 * u64::from(colour.bit_depth()).div_ceil(8);
    let _reserved = place.check_size([width.into(), height.into()], bytes, ratio::TIFF)?;
    let planar = decoder.find_tag_unsigned::<u16>(Tag::PlanarConfiguration).map_err(invalid)? == Some(2);
    let orientation = decoder.find_tag_unsigned::<u16>(Tag::Orientation).map_err(invalid)?.unwrap_or(1);
    let mut result = DecodingResult::U8(Vec::new());
    let of_jpeg = tiff_jpeg::pixels(&mut decoder, colour, count, place)?;
    let is_ycbcr = colour == ColorType::YCbCr(8) && of_jpeg.is_none();
    if let Some(pixels) = of_jpeg {
        result = DecodingResult::U8(pixels);
    } else {
        decoder.read_image_to_buffer(&mut result).map_err(invalid)?;
    }
    let (width, height) = (width as usize, height as usize);
    let layout = Interleaving { count, planar, texels: width * height };
    if let (true, DecodingResult::U8(samples)) = (is_ycbcr, &mut result) {
        layout.to_rgb(samples);
    }
    let kind = kind(&result);
    let (channels, depth) = layout.samples(result).ok_or_else(|| {
        let problem = format!("expected unsigned integers of 8, 16 or 32 bits, or floats, found {kind}");
        place.bad(problem, "convert it")
    })?;
    let raster = Raster::with_alpha(width, height, depth, channels).oriented(orientation);
    let notes = has_pages(&mut decoder).then_some(Note::FirstOnly(place.what)).into_iter().collect();
    Ok(Decoded { notes, ..alone(raster) })
}

/// The name of a compression by its code.
fn compression(code: u16) -> Option<&'static str> {
    Some(match code {
        33_003 | 33_005 | 34_712 => "JPEG 2000",
        34_887 => "LERC",
        34_925 => "LZMA",
        34_926 | 50_000 => "Zstandard (ZSTD)",
        34_927 | 50_001 => "WebP",
        34_933 => "PNG",
        22_610 | 34_934 => "JPEG XR",
        50_002 | 52_546 => "JPEG XL",
        _ => return None,
    })
}

/// What the samples are, for messages.
fn kind(result: &DecodingResult) -> &'static str {
    match result {
        DecodingResult::I8(_) => "signed integers of 8 bits",
        DecodingResult::I16(_) => "signed integers of 16 bits",
        DecodingResult::I32(_) => "signed integers of 32 bits",
        DecodingResult::I64(_) | DecodingResult::U64(_) => "integers of 64 bits",
        _ => "others",
    }
}

/// Whether there are pictures after the first which are no smaller levels of it.
fn has_pages(decoder: &mut Decoder<Reader<'_>>) -> bool {
    const REDUCED: u32 = 1;
    const MOST: usize = 32;
    let mut next = || -> tiff::TiffResult<bool> {
        decoder.next_image()?;
        Ok(decoder.find_tag_unsigned::<u32>(Tag::NewSubfileType)?.unwrap_or(0) & REDUCED == 0)
    };
    let mut count = 0;
    std::iter::from_fn(|| {
        count += 1;
        (count <= MOST).then(|| next().ok())?
    })
    .any(|is_page| is_page)
}

fn channels_of(colour: ColorType) -> Option<usize> {
    match colour {
        ColorType::Gray(_) => Some(1),
        ColorType::GrayA(_) => Some(2),
        ColorType::RGB(_) | ColorType::YCbCr(8) => Some(3),
        ColorType::RGBA(_) => Some(4),
        ColorType::Multiband { num_samples, .. } => {
            Some(usize::from(num_samples)).filter(|n| (1..=4).contains(n))
        }
        _ => None,
    }
}

/// How the samples of a picture lie in memory.
struct Interleaving {
    count: usize,
    planar: bool,
    texels: usize,
}

impl Interleaving {
    /// `None` for other kinds of samples, and where there are not as many as there have to be.
    fn samples(&self, result: DecodingResult) -> Option<(Vec<Samples>, &'static str)> {
        Some(match result {
            DecodingResult::U8(all) => (self.channels(all)?, "8-bit"),
            DecodingResult::U16(all) => (self.channels(all)?, "16-bit"),
            DecodingResult::U32(all) => {
                // Integers, which are encoded as others are: as 16 bits, which are enough.
                let of = |s: u32| ((u64::from(s) + 0x8000) / 0x1_0001) as u16;
                (self.channels(all.into_iter().map(of).collect::<Vec<_>>())?, "32-bit")
            }
            DecodingResult::F16(all) => (self.floats(all, f32::from)?, "half"),
            DecodingResult::F32(all) => (self.channels(all)?, "float"),
            DecodingResult::F64(all) => (self.floats(all, |s| s as f32)?, "double"),
            _ => return None,
        })
    }

    /// Y, Cb and Cr of ITU-R BT.601, all of 0 to 255, as R, G and B: in the integers of libjpeg.
    fn to_rgb(&self, samples: &mut [u8]) {
        let (step, stride) = if self.planar { (1, self.texels) } else { (3, 1) };
        for texel in 0..self.texels {
            let [y, cb, cr] = [0, 1, 2].map(|channel| {
                samples.get(texel * step + channel * stride).map_or(0, |sample| i32::from(*sample))
            });
            let (cb, cr) = (cb - 128, cr - 128);
            let rgb = [
                y + ((91_881 * cr + 32_768) >> 16),
                y + ((-22_554 * cb - 46_802 * cr + 32_768) >> 16),
                y + ((116_130 * cb + 32_768) >> 16),
            ];
            for (channel, value) in rgb.into_iter().enumerate() {
                if let Some(sample) = samples.get_mut(texel * step + channel * stride) {
                    *sample = value.clamp(0, 255) as u8;
                }
            }
        }
    }

    fn floats<S>(&self, samples: Vec<S>, of: impl Fn(S) -> f32) -> Option<Vec<Samples>> {
        self.channels(samples.into_iter().map(of).collect::<Vec<f32>>())
    }

    fn channels(&self, samples: impl Into<Buffer>) -> Option<Vec<Samples>> {
        let buffer = samples.into();
        let channels = if self.planar { Samples::planar } else { Samples::interleaved };
        (buffer.len() == self.count * self.texels).then(|| channels(buffer, self.count))
    }
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;
    use crate::read::record::Subject;

    #[test]
    fn bits_are_refused_also_where_a_row_has_as_many_bytes_as_texels() {
        // Width, height, bits, compression, photometric, offset of the strip, samples, rows and bytes of it.
        let fields =
            [(256, 1), (257, 2), (258, 1), (259, 1), (262, 1), (273, 8), (277, 1), (278, 2), (279, 2_u32)];
        let mut file = b"II*\0\x0a\0\0\0\x80\0\x09\0".to_vec();
        for (tag, value) in fields {
            file.extend([u16::to_le_bytes(tag), 4_u16.to_le_bytes()].as_flattened());
            file.extend([1_u32.to_le_bytes(), value.to_le_bytes()].as_flattened());
        }
        file.extend([0; 4]);
        let place = DecodedFile::of(Path::new("m.tif"), Subject::Material);
        let refused = decode(Reader::of_bytes(&file), place).unwrap_err().to_string();
        assert!(refused.contains("found a TIFF with a depth of 1;"), "{refused}");
    }

    #[test]
    fn ycbcr_is_the_rgb_of_libjpeg_in_pixels_and_in_planes() {
        // Y, Cb and Cr, and what libjpeg-turbo makes of them.
        let texels =
            [([76, 85, 255], [254, 0, 0]), ([150, 44, 21], [0, 255, 1]), ([128, 128, 128], [128; 3])];
        let mut pixels: Vec<u8> = texels.iter().flat_map(|(ycbcr, _)| *ycbcr).collect();
        let mut planes: Vec<u8> = (0..3).flat_map(|c| texels.map(|(ycbcr, _)| ycbcr[c])).collect();
        let layout = |planar| Interleaving { count: 3, planar, texels: texels.len() };
        layout(false).to_rgb(&mut pixels);
        layout(true).to_rgb(&mut planes);
        for (texel, (_, rgb)) in texels.iter().enumerate() {
            let [of_pixels, of_planes] =
                [[0, 1, 2].map(|c| pixels[3 * texel + c]), [0, 1, 2].map(|c| planes[3 * c + texel])];
            assert_eq!((of_pixels, of_planes), (*rgb, *rgb));
        }
    }
}
