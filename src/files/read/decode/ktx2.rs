//! KTX2 of Basis Universal (ETC1S and UASTC, also in Zstandard) through the `basisu` library; the largest level.

use std::io::Read as _;

use basisu::{DecodeFlags, TargetFormat, Transcoder};

use super::place::{DecodedFile, MAX_BYTES};
use super::reader::Reader;
use crate::disk::panics::caught;
use crate::error::Error;
use crate::read::raster::{Raster, Samples};

/// How a KTX2 begins.
pub(crate) const MAGIC: &[u8] = b"\xabKTX 20\xbb\r\n\x1a\n";
/// Bytes of the header up to the index of its levels.
const HEADER: usize = 80;

pub(crate) fn decode(reader: Reader<'_>, place: DecodedFile<'_>) -> Result<Raster, Error> {
    let mut bytes = Vec::new();
    let unreadable = |source| Error::unreadable(place.path, source);
    reader.take(MAX_BYTES).read_to_end(&mut bytes).map_err(unreadable)?;
    let header = bytes.get(..HEADER).ok_or_else(|| place.truncated())?;
    let word =
        |at: usize| header[at..at + 4].iter().rev().fold(0_u32, |word, &byte| word << 8 | u32::from(byte));
    let [format, width, height, depth, layers, faces] = [12, 20, 24, 28, 32, 36].map(word);
    if format != 0 {
        let problem =
            format!("expected Basis Universal (ETC1S or UASTC), found a KTX2 in Vulkan format {format}");
        return Err(place.bad(problem, "convert it to PNG"));
    }
    if depth > 1 || layers > 1 || faces != 1 {
        let problem = "expected one picture, found a KTX2 of a cube map, a volume or several pictures";
        return Err(place.bad(problem, "save the map by itself"));
    }
    let texels = u64::from(width) * u64::from(height);
    let _reserved = place.check_size(width.into(), height.into(), texels.saturating_mul(4))?;
    let transcode = || {
        let transcoder = Transcoder::new(&bytes)?;
        transcoder.transcode(0, TargetFormat::Rgba32, DecodeFlags::NONE)
    };
    let pixels = caught(transcode)
        .map_err(|_| place.invalid("KTX2", "a contradiction in it"))?
        .map_err(|error| explain(&error, place))?;
    let (width, height) = (width as usize, height as usize);
    if pixels.len() != 4 * width * height {
        return Err(place.invalid("KTX2", "a contradiction in its size"));
    }
    Ok(Raster::with_alpha(width, height, "8-bit", Samples::interleaved(pixels, 4)))
}

fn explain(error: &basisu::Error, place: DecodedFile<'_>) -> Error {
    match error {
        basisu::Error::Truncated => place.truncated(),
        basisu::Error::Unsupported { source, .. } => {
            let problem = format!("expected ETC1S or UASTC, found a KTX2 in {source:?}");
            place.bad(problem, "convert it to PNG")
        }
        other => place.invalid("KTX2", format!("{other:?}")),
    }
}
