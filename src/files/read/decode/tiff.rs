//! TIFF through the `tiff` library: integers of 8, 16 and 32 bits, half, float and double, in pixels or planes.

use tiff::ColorType;
use tiff::TiffUnsupportedError as Unsupported;
use tiff::decoder::{ChunkType, Decoder, DecodingResult, Limits};
use tiff::tags::{PhotometricInterpretation, Tag};

use super::place::{ByteReader, Decoded, DecodedFile, MAX_BYTES, alone, ratio};
use super::tiff_jpeg;
use crate::disk::caught;
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
    let (count, planar) = channels(&mut decoder, colour, place)?;
    let bytes = u64::from(width) * u64::from(height) * count as u64 * u64::from(bits).div_ceil(8);
    let _reserved = place.check_size([width.into(), height.into()], bytes, ratio::TIFF)?;
    let orientation = decoder.find_tag_unsigned::<u16>(Tag::Orientation).map_err(invalid)?.unwrap_or(1);
    let mut result = DecodingResult::U8(Vec::new());
    match tiff_jpeg::pixels(&mut decoder, colour, count, place)? {
        Some(pixels) => result = DecodingResult::U8(pixels),
        None if matches!(colour, ColorType::YCbCr(_)) => {
            return Err(refused("in YCbCr without JPEG", place));
        }
        None => {
            caught(|| decoder.read_image_to_buffer(&mut result))
                .map_err(|_| place.invalid("TIFF", "a contradiction in it"))?
                .map_err(invalid)?;
        }
    }
    let (width, height) = (width as usize, height as usize);
    let layout = Interleaving { count, planar, texels: width * height };
    if let DecodingResult::U8(samples) = &mut result
        && bits < 8
    {
        *samples = unpacked(samples, width, bits.into());
    }
    let kind = kind(&result);
    let (channels, depth) = layout.samples(result).ok_or_else(|| refused(&format!("of {kind}"), place))?;
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
            refused(&format!("in {name}"), place)
        }
        tiff::TiffError::UnsupportedError(Unsupported::InterpretationWithBits(kind, bits)) => {
            let kind = match kind {
                PhotometricInterpretation::RGBPalette => "with a palette".to_owned(),
                other => format!("in {other:?}"),
            };
            refused(&format!("{kind} of {} bits", bits.first().unwrap_or(&0)), place)
        }
        tiff::TiffError::UnsupportedError(what) => refused(&format!("in which {what}"), place),
        other => place.invalid("TIFF", other),
    }
}

/// The refusal of a TIFF that is not read; `found` tells what is unusual about it.
fn refused(found: &str, place: DecodedFile<'_>) -> Error {
    let expected = "expected gray or RGB of 8, 16 or 32 bits or of floats, or gray of 1, 2 or 4 bits";
    place.bad(format!("{expected}, found a TIFF {found}"), &place.to_png())
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

/// The number of channels of a picture of these colours, and whether each is a plane.
///
/// # Errors
/// [`Error::BadImage`] where it is not read.
fn channels(
    decoder: &mut Decoder<ByteReader<'_>>,
    colour: ColorType,
    place: DecodedFile<'_>,
) -> Result<(usize, bool), Error> {
    let bits = colour.bit_depth();
    let count = match colour {
        ColorType::Gray(1 | 2 | 4) => 1,
        _ if !matches!(bits, 8 | 16 | 32 | 64) => return Err(refused(&format!("of {bits} bits"), place)),
        ColorType::Gray(_) => 1,
        ColorType::GrayA(_) => 2,
        ColorType::RGB(_) | ColorType::YCbCr(8) => 3,
        ColorType::RGBA(_) => 4,
        ColorType::Multiband { num_samples: count @ 1..=4, .. } => count.into(),
        other => return Err(refused(&format!("of {other:?}"), place)),
    };
    let (height, tile) = (decoder.dimensions().map_or(0, |size| size.1), decoder.chunk_dimensions().1.max(1));
    let planes = decoder.find_tag_unsigned::<u16>(Tag::PlanarConfiguration);
    let is_planar = planes.map_err(|error| explained(error, place))? == Some(2) && count > 1;
    // tiff 0.11.3 puts the last of their rows at the wrong place.
    if is_planar && decoder.get_chunk_type() == ChunkType::Tile && !height.is_multiple_of(tile) {
        let found = format!("of planes in tiles of {tile} rows, of which {height} is no multiple");
        return Err(refused(&found, place));
    }
    Ok((count, is_planar))
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
    use std::io::Cursor;
    use std::path::Path;

    use super::*;
    use crate::read::decode::reader;
    use crate::read::record::Subject;

    /// A TIFF of these fields, the numbers of all but those of one behind them, with `data` from byte 8 on.
    fn file(fields: &[(u16, &[u32])], data: &[u8]) -> Vec<u8> {
        let start = 8 + data.len().next_multiple_of(4);
        let mut file = [b"II*\0", &(start as u32).to_le_bytes()[..], data].concat();
        file.resize(start, 0);
        file.extend([fields.len() as u8, 0]);
        let mut numbers = Vec::new();
        for (tag, values) in fields {
            let place = (start + 12 * fields.len() + 6 + numbers.len()) as u32;
            let value = if let [value] = values { *value } else { place };
            file.extend([u16::to_le_bytes(*tag), 4_u16.to_le_bytes()].as_flattened());
            file.extend([(values.len() as u32).to_le_bytes(), value.to_le_bytes()].as_flattened());
            numbers.extend(values.iter().filter(|_| values.len() > 1).flat_map(|value| value.to_le_bytes()));
        }
        [file, vec![0; 4], numbers].concat()
    }

    fn read(file: &[u8]) -> Result<Vec<f64>, String> {
        let place = DecodedFile::of(Path::new("m.tif"), Subject::Material);
        let decoded = decode(reader(Cursor::new(file)), place).map_err(|error| error.to_string())?;
        let plane = &decoded.layers[0].raster.channels[0];
        Ok((0..plane.len()).map(|at| plane.stored(at)).collect())
    }

    #[test]
    fn gray_of_few_bits_is_read_and_what_is_unusual_is_named_with_what_to_type() {
        let row = |width: u32, bits: u32, photometric: u32, row: &[u8]| {
            let tags = [256, 257, 258, 259, 262, 273, 277, 278, 279];
            let values = [width, 1, bits, 1, photometric, 8, 1, 1, row.len() as u32];
            let fields: Vec<(u16, &[u32])> = tags.into_iter().zip(values.chunks(1)).collect();
            read(&file(&fields, row))
        };
        // From black or from white.
        assert_eq!(row(3, 1, 1, &[0b1010_0000]), Ok(vec![255.0, 0.0, 255.0]));
        assert_eq!(row(3, 1, 0, &[0b1010_0000]), Ok(vec![0.0, 255.0, 0.0]));
        assert_eq!(row(3, 4, 1, &[0xf0, 0x80]), Ok(vec![255.0, 0.0, 136.0]));
        // Three planes in tiles of 16 x 16 texels.
        let tiles = |height: u32| {
            let fields: [(u16, &[u32]); 11] = [
                (256, &[16]),
                (257, &[height]),
                (258, &[8, 8, 8]),
                (259, &[1]),
                (262, &[2]),
                (277, &[3]),
                (284, &[2]),
                (322, &[16]),
                (323, &[16]),
                (324, &[8, 8, 8]),
                (325, &[256, 256, 256]),
            ];
            read(&file(&fields, &[7; 256]))
        };
        assert_eq!(tiles(16), Ok(vec![7.0; 256]));
        for (refused, found) in [
            (row(2, 12, 1, &[0; 3]), "a TIFF of 12 bits"),
            (row(2, 8, 3, &[0; 2]), "a TIFF with a palette of 8 bits"),
            (row(2, 8, 6, &[0; 2]), "a TIFF in YCbCr"),
            (tiles(9), "planes in tiles of 16 rows, of which 9 is no multiple"),
        ] {
            let refused = refused.unwrap_err();
            assert!(refused.contains(found) && refused.contains("magick m.tif m.png"), "{refused}");
        }
    }
}
