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
    /// The chunk that declares its values linear: cICP, or else gAMA without sRGB.
    pub linear: Option<&'static str>,
    /// The chunk that declares primaries other than those of Rec. 709: cICP, or else cHRM without sRGB.
    pub other_primaries: Option<&'static str>,
    /// Whether it is an animation.
    pub is_animated: bool,
    /// The text that this program writes into packed pictures: their order and encoding.
    pub meaning: Option<String>,
}

/// Longest text that is looked at.
const LONGEST: u32 = 1 << 10;

/// The code of linear values in cICP (ITU-T H.273).
const LINEAR: u8 = 8;
/// The chromaticities of red, green and blue of Rec. 709, in 1/100000.
const REC709: [u32; 6] = [64_000, 33_000, 30_000, 60_000, 15_000, 6_000];

/// The first numbers of a chunk, of whose bytes so many are `left`.
fn numbers<const N: usize>(reader: &mut Reader<'_>, left: &mut i64) -> io::Result<[u32; N]> {
    let mut numbers = [0; N];
    for number in &mut numbers {
        let mut bytes = [0; 4];
        reader.read_exact(&mut bytes)?;
        *number = u32::from_be_bytes(bytes);
        *left -= 4;
    }
    Ok(numbers)
}

pub(crate) fn png(reader: &mut Reader<'_>) -> io::Result<PngHead> {
    const KEYWORD: &[u8] = b"svbrdf\0packed ";
    let (mut gamma_is_one, mut srgb, mut is_animated, mut meaning) = (false, false, false, None);
    let (mut cicp, mut primaries): (Option<[u8; 4]>, Option<[u32; 6]>) = (None, None);
    reader.seek_relative(8)?;
    loop {
        let (mut length, mut name) = ([0; 4], [0; 4]);
        reader.read_exact(&mut length)?;
        reader.read_exact(&mut name)?;
        let length = u32::from_be_bytes(length);
        let mut left = i64::from(length) + 4;
        match &name {
            b"IDAT" => {
                let linear = match cicp {
                    Some([_, transfer, ..]) => (transfer == LINEAR).then_some("cICP"),
                    None => (gamma_is_one && !srgb).then_some("gAMA"),
                };
                // Of cICP, 2 are not specified.
                let is_far = |all: &[u32; 6]| all.iter().zip(REC709).any(|(a, b)| a.abs_diff(b) > 1000);
                let other_primaries = match cicp {
                    Some([primaries, ..]) => (!matches!(primaries, 1 | 2)).then_some("cICP"),
                    None => primaries.filter(is_far).filter(|_| !srgb).map(|_| "cHRM"),
                };
                return Ok(PngHead { linear, other_primaries, is_animated, meaning });
            }
            b"sRGB" => srgb = true,
            b"acTL" => is_animated = numbers::<1>(reader, &mut left)?[0] > 1,
            b"tEXt" if length <= LONGEST => {
                let mut text = vec![0; length as usize];
                reader.read_exact(&mut text)?;
                left -= i64::from(length);
                let written =
                    text.strip_prefix(KEYWORD).map(|text| String::from_utf8_lossy(text).into_owned());
                meaning = written.or(meaning);
            }
            b"gAMA" => gamma_is_one = numbers::<1>(reader, &mut left)?[0].abs_diff(100_000) < 1000,
            b"cHRM" => {
                let [_, _, rest @ ..]: [u32; 8] = numbers(reader, &mut left)?;
                primaries = Some(rest);
            }
            b"cICP" => cicp = Some(numbers::<1>(reader, &mut left)?[0].to_be_bytes()),
            _ => (),
        }
        reader.seek_relative(left)?;
    }
}
