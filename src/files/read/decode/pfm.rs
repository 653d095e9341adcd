//! PFM: three lines of text, then floats of gray or RGB, the lowest row first.

use std::io::{BufRead as _, Read as _};

use super::place::{ByteReader, DecodedFile, MAX_BYTES, ratio};
use crate::error::Error;
use crate::read::raster::{Raster, Samples};

/// Most bytes of a line of text.
const LONGEST: u64 = 64;

pub(crate) fn decode(mut reader: ByteReader<'_>, place: DecodedFile<'_>) -> Result<Raster, Error> {
    let unreadable = |source| Error::unreadable(place.path, source);
    let mut line = || {
        let mut text = Vec::new();
        (&mut reader).take(LONGEST).read_until(b'\n', &mut text).map_err(unreadable)?;
        Ok::<_, Error>(String::from_utf8_lossy(&text).trim().to_owned())
    };
    let [kind, size, scale] = [line()?, line()?, line()?];
    let invalid = || place.invalid("PFM", format!("the lines `{kind}`, `{size}` and `{scale}`"));
    let sides: Option<Vec<u64>> = size.split_whitespace().map(|side| side.parse().ok()).collect();
    let Some([width, height]) = sides.as_deref() else { return Err(invalid()) };
    // The sign of the scale tells the order of the bytes, its size is that of nothing known.
    let scale: f32 =
        scale.parse().ok().filter(|scale: &f32| *scale != 0.0 && scale.is_finite()).ok_or_else(invalid)?;
    let count = if kind == "PF" { 3 } else { 1 };
    let bytes = width.saturating_mul(*height).saturating_mul(4 * count);
    let _reserved = place.check_size([*width, *height], bytes.min(MAX_BYTES + 1), ratio::PFM)?;
    let (width, height, count) = (*width as usize, *height as usize, count as usize);
    let _reserved_for_file = place.reserve(bytes)?;
    let mut stored = Vec::new();
    reader.take(bytes).read_to_end(&mut stored).map_err(unreadable)?;
    if stored.len() as u64 != bytes {
        return Err(place.truncated());
    }
    let float =
        |bytes: &[u8; 4]| if scale < 0.0 { f32::from_le_bytes(*bytes) } else { f32::from_be_bytes(*bytes) };
    let rows = stored.as_chunks().0.chunks(width * count).rev();
    let values: Vec<f32> = rows.flatten().map(float).collect();
    Ok(Raster::with_alpha(width, height, "float", Samples::interleaved(values, count)))
}
