//! Headers of PNG and HDR: what the decoding libraries do not return of them, or do not limit.

use std::io::{self, Read as _, Seek as _};

use super::reader::Reader;

/// Most bytes of the header of an HDR.
pub(crate) const LONGEST_HDR: u64 = 64 << 10;

/// Whether the header of an HDR, an empty line and the line of the resolution at its end, is at most [`LONGEST_HDR`] long, or else
/// the file: the library reads it to an end that may never come.
pub(crate) fn is_hdr_head_short(reader: &mut Reader<'_>) -> io::Result<bool> {
    let mut head = Vec::new();
    reader.take(LONGEST_HDR).read_to_end(&mut head)?;
    let end = head.windows(2).position(|two| two == b"\n\n");
    let has_resolution = end.is_some_and(|end| head[end + 2..].contains(&b'\n'));
    Ok(has_resolution || (head.len() as u64) < LONGEST_HDR)
}

/// The fields of a PNG before its pixels.
#[derive(Debug, Default)]
pub(crate) struct PngHead {
    /// Whether a gAMA chunk, without an sRGB one, declares its values linear.
    pub linear: bool,
    /// The text that this program writes into packed pictures: their order and encoding.
    pub meaning: Option<String>,
}

/// Longest text that is looked at.
const LONGEST: u32 = 1 << 10;

pub(crate) fn png(reader: &mut Reader<'_>) -> io::Result<PngHead> {
    const KEYWORD: &[u8] = b"svbrdf\0packed ";
    let (mut gamma_is_one, mut srgb, mut meaning) = (false, false, None);
    reader.seek_relative(8)?;
    loop {
        let (mut length, mut name) = ([0; 4], [0; 4]);
        reader.read_exact(&mut length)?;
        reader.read_exact(&mut name)?;
        let length = u32::from_be_bytes(length);
        let mut left = i64::from(length) + 4;
        match &name {
            b"IDAT" => return Ok(PngHead { linear: gamma_is_one && !srgb, meaning }),
            b"sRGB" => srgb = true,
            b"tEXt" if length <= LONGEST => {
                let mut text = vec![0; length as usize];
                reader.read_exact(&mut text)?;
                left -= i64::from(length);
                let written =
                    text.strip_prefix(KEYWORD).map(|text| String::from_utf8_lossy(text).into_owned());
                meaning = written.or(meaning);
            }
            b"gAMA" => {
                let mut gamma = [0; 4];
                reader.read_exact(&mut gamma)?;
                left -= 4;
                gamma_is_one = u32::from_be_bytes(gamma).abs_diff(100_000) < 1000;
            }
            _ => (),
        }
        reader.seek_relative(left)?;
    }
}
