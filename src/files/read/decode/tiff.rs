//! TIFF through the `tiff` library: integers of 8, 16 and 32 bits, half, float and double, in pixels or planes.

use tiff::ColorType;
use tiff::TiffUnsupportedError as Unsupported;
use tiff::decoder::{Decoder, DecodingResult, Limits};
use tiff::tags::Tag;

use super::place::{Decoded, DecodedFile, MAX_BYTES, alone, ratio};
use super::reader::ByteReader;
use super::tiff_jpeg;
use crate::error::Error;
use crate::read::raster::{Buffer, Raster, Samples};
use crate::read::record::Note;

pub(crate) fn decode(reader: ByteReader<'_>, place: DecodedFile<'_>) -> Result<Decoded, Error> {
    let invalid = |error| explained(error, place);
    let mut limits = Limits::default();
    limits.decoding_buffer_size = usize::try_from(MAX_BYTES).unwrap_or(usize::MAX);
    limits.intermediate_buffer_size = limits.decoding_buffer_size;
    let mut decoder = Decoder::new(reader).map_err(invalid)?.with_limits(limits);
    skip_thumbnails(&mut decoder).map_err(invalid)?;
    let (width, height) = decoder.dimensions().map_err(invalid)?;
    let colour = decoder.colortype().map_err(invalid)?;
    let bits = colour.bit_depth();
    let is_read = matches!(bits, 8 | 16 | 32 | 64) || matches!(colour, ColorType::Gray(1 | 2 | 4));
    if !is_read {
        let problem =
            format!("expected 8, 16 or 32 bits a sample, or gray of 1, 2 or 4, found a TIFF of {bits} bits");
        return Err(place.bad(problem, "save it with 8 or 16 bits"));
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
    if let DecodingResult::U8(samples) = &mut result {
        if is_ycbcr {
            layout.to_rgb(samples);
        } else if bits < 8 {
            *samples = unpacked(samples, width, bits.into());
        }
    }
    let kind = kind(&result);
    let (channels, depth) = layout.samples(result).ok_or_else(|| {
        let problem = format!("expected unsigned integers of 8, 16 or 32 bits, or floats, found {kind}");
        place.bad(problem, "convert it")
    })?;
    let raster = place.raster([width, height], depth, channels).oriented(orientation);
    with_metadata(raster, &mut decoder, place).map_err(invalid)
}

/// The picture of a page with what its fields do to it, and the notes on the rest of the file.
fn with_metadata(
    mut raster: Raster,
    decoder: &mut Decoder<ByteReader<'_>>,
    place: DecodedFile<'_>,
) -> tiff::TiffResult<Decoded> {
    let extra = decoder.find_tag_unsigned_vec::<u16>(Tag::ExtraSamples)?.unwrap_or_default();
    let profile = decoder.find_tag(Tag::IccProfile).ok().flatten().and_then(|one| one.into_u8_vec().ok());
    let mut notes = place.metadata_notes(1, profile.as_deref());
    // Alpha that the colours are multiplied by is the first kind of extra samples.
    if extra.first() == Some(&1) && raster.alpha.is_some() {
        notes.push(Note::Unmultiplied(place.what));
        raster = raster.unmultiplied();
    }
    notes.extend(has_pages(decoder).then_some(Note::FirstOnly(place.what)));
    Ok(Decoded { notes, ..alone(raster) })
}

fn explained(error: tiff::TiffError, place: DecodedFile<'_>) -> Error {
    match error {
        tiff::TiffError::IoError(io) if io.kind() == std::io::ErrorKind::UnexpectedEof => place.truncated(),
        tiff::TiffError::UnsupportedError(Unsupported::UnsupportedCompressionMethod(method)) => {
            let name = compression(method.to_u16()).map_or_else(|| format!("{method:?}"), str::to_owned);
            place.bad(
                format!("expected a compression that is read, found a TIFF in {name}"),
                "save it with LZW or Deflate",
            )
        }
        tiff::TiffError::UnsupportedError(Unsupported::InterpretationWithBits(kind, bits)) => place.bad(
            format!("expected gray or RGB, found a TIFF of {kind:?} in {} bits", bits.first().unwrap_or(&0)),
            "save it as gray or RGB of 8 or 16 bits",
        ),
        tiff::TiffError::UnsupportedError(what) => {
            place.bad(format!("expected gray or RGB, found a TIFF in which {what}"), "convert it to RGB")
        }
        other => place.invalid("TIFF", other),
    }
}

/// Codes of 8 bits of samples of fewer, of which several are in a byte and rows begin with one.
fn unpacked(packed: &[u8], width: usize, bits: usize) -> Vec<u8> {
    let most = u8::MAX >> (8 - bits);
    let code = |row: &[u8], x: usize| row[x * bits / 8] >> (8 - bits - x * bits % 8) & most;
    let rows = packed.chunks_exact((width * bits).div_ceil(8));
    rows.flat_map(|row| (0..width).map(move |x| code(row, x) * (u8::MAX / most))).collect()
}

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

/// Most pages that are looked at.
const MOST_PAGES: usize = 32;

/// Whether a page calls itself a smaller version of another one.
fn is_reduced(decoder: &mut Decoder<ByteReader<'_>>) -> tiff::TiffResult<bool> {
    let [new, old] = [Tag::NewSubfileType, Tag::SubfileType]
        .map(|tag| decoder.find_tag_unsigned::<u32>(tag).ok().flatten().unwrap_or(0));
    Ok(new & 1 != 0 || old == 2)
}

/// Goes to the first page that is no smaller version of another one; to the first of all where each is.
fn skip_thumbnails(decoder: &mut Decoder<ByteReader<'_>>) -> tiff::TiffResult<()> {
    for _ in 0..MOST_PAGES {
        if !is_reduced(decoder)? {
            return Ok(());
        }
        if !decoder.more_images() || decoder.next_image().is_err() {
            break;
        }
    }
    decoder.seek_to_image(0)
}

/// Whether there are pages after this one which are no smaller versions of it.
fn has_pages(decoder: &mut Decoder<ByteReader<'_>>) -> bool {
    (0..MOST_PAGES)
        .map_while(|_| decoder.next_image().and_then(|()| is_reduced(decoder)).ok())
        .any(|is_reduced| !is_reduced)
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

    /// A TIFF of a row of `bits` a sample, whose bytes these are.
    fn file(width: u32, bits: u32, photometric: u32, row: &[u8]) -> Vec<u8> {
        let length = row.len() as u32;
        let fields = [
            (256, width),
            (257, 1),
            (258, bits),
            (259, 1),
            (262, photometric),
            (273, 8),
            (277, 1),
            (278, 1),
            (279, length),
        ];
        let mut file = [b"II*\0", &(8 + length.next_multiple_of(4)).to_le_bytes()[..], row].concat();
        file.resize(8 + row.len().next_multiple_of(4), 0);
        file.extend([fields.len() as u8, 0]);
        for (tag, value) in fields {
            file.extend([u16::to_le_bytes(tag), 4_u16.to_le_bytes()].as_flattened());
            file.extend([1_u32.to_le_bytes(), value.to_le_bytes()].as_flattened());
        }
        file.extend([0; 4]);
        file
    }

    #[test]
    fn gray_of_few_bits_is_read_and_other_bits_are_named() {
        let read = |file: &[u8]| {
            let place = DecodedFile::of(Path::new("m.tif"), Subject::Material);
            let decoded = decode(ByteReader::of_bytes(file), place).map_err(|error| error.to_string())?;
            let plane = &decoded.layers[0].raster.channels[0];
            Ok::<_, String>((0..plane.len()).map(|at| plane.stored(at)).collect::<Vec<_>>())
        };
        // From black or from white.
        assert_eq!(read(&file(3, 1, 1, &[0b1010_0000])), Ok(vec![255.0, 0.0, 255.0]));
        assert_eq!(read(&file(3, 1, 0, &[0b1010_0000])), Ok(vec![0.0, 255.0, 0.0]));
        assert_eq!(read(&file(3, 4, 1, &[0xf0, 0x80])), Ok(vec![255.0, 0.0, 136.0]));
        let refused = read(&file(2, 12, 1, &[0; 3])).unwrap_err();
        assert!(refused.contains("found a TIFF of 12 bits"), "{refused}");
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
