//! JPEG: the values that libjpeg-turbo gives, on which this field trains and evaluates. What libjpeg-turbo-rs 0.8.0 decodes to other values
//! is refused; `python/tests/test_jpeg.py` compares both.

use std::io::Read as _;

use libjpeg_turbo_rs::{ColorSpace, DecodeLimits, Decoder, JpegError, PixelFormat};

use super::place::{ByteReader, Decoded, DecodedFile, alone, ratio};
use crate::disk::caught;
use crate::error::Error;
use crate::read::raster::{Raster, Samples};

/// The bytes of a pixel that the decoder takes beside its result: planes of coefficients and of colours.
const WORKING: u64 = 9;

pub(super) struct Pixels {
    pub size: [usize; 2],
    /// Channels of a pixel: 1 or 3.
    pub count: usize,
    /// Pixel by pixel.
    pub values: Vec<u8>,
    orientation: u8,
    profile: Option<Vec<u8>>,
}

pub(super) fn decode(mut reader: ByteReader<'_>, place: DecodedFile<'_>) -> Result<Decoded, Error> {
    let unreadable = |error| Error::unreadable(place.path, error);
    let _reserved_for_file = place.reserve(place.length)?;
    let mut bytes = Vec::new();
    reader.read_to_end(&mut bytes).map_err(unreadable)?;
    // Sizes are checked with the memory, for a message with their numbers.
    let most = [usize::from(u16::MAX); 2];
    let Pixels { size: [width, height], count, values, orientation, profile } = pixels(&bytes, most, place)?;
    let notes = place.metadata_notes(orientation, profile.as_deref());
    let raster = Raster::with_alpha(width, height, "8-bit", Samples::interleaved(values, count));
    let raster = if place.is_photograph() { raster.oriented(orientation.into()) } else { raster };
    Ok(Decoded { notes, ..alone(raster) })
}

/// Decodes the JPEG of these bytes, of `most` pixels (width, height).
///
/// # Errors
/// [`Error::BadImage`], [`Error::Memory`].
pub(super) fn pixels(bytes: &[u8], most: [usize; 2], place: DecodedFile<'_>) -> Result<Pixels, Error> {
    let contradiction = |_| place.invalid("JPEG", "a contradiction in it");
    let broken = |error: JpegError| match error {
        JpegError::UnexpectedEof => place.truncated(),
        error => place.invalid("JPEG", error),
    };
    let [max_width, max_height] = most;
    let limits = DecodeLimits { max_width, max_height, max_pixels: u64::MAX, ..DecodeLimits::default() };
    let mut decoder =
        caught(|| Decoder::new_with_limits(bytes, limits)).map_err(contradiction)?.map_err(broken)?;
    let header = decoder.header();
    let ([width, height], count) = ([header.width, header.height], header.components.len());
    let format = match count {
        1 => PixelFormat::Grayscale,
        3 => PixelFormat::Rgb,
        _ => {
            let problem = format!("expected gray or RGB, found {count} components");
            return Err(place.bad(problem, "convert it to RGB"));
        }
    };
    if let Some(found) = differing(&decoder) {
        let expected = "expected gray, YCbCr, or RGB with every component at full size";
        return Err(place.bad(format!("{expected}, found {found}"), "convert it to PNG in RGB"));
    }
    let size = u64::from(width) * u64::from(height);
    let most = if decoder.is_arithmetic() { ratio::NONE } else { ratio::JPEG };
    let _reserved = place.check_size([width.into(), height.into()], size * count as u64, most)?;
    let _reserved_for_work = place.reserve(size * WORKING)?;
    if !is_whole(bytes) {
        return Err(place.truncated());
    }
    let orientation = decoder.exif_orientation().unwrap_or(1);
    decoder.set_output_format(format);
    let image = caught(|| decoder.decode_image()).map_err(contradiction)?.map_err(broken)?;
    let profile = image.icc_profile().map(<[u8]>::to_vec);
    Ok(Pixels { size: [width.into(), height.into()], count, values: image.into_vec(), orientation, profile })
}

/// What libjpeg-turbo-rs 0.8.0 does not decode to the values of libjpeg-turbo.
fn differing(decoder: &Decoder<'_>) -> Option<&'static str> {
    let components = &decoder.header().components;
    let sampling: Vec<_> =
        components.iter().map(|one| [one.horizontal_sampling, one.vertical_sampling]).collect();
    let first = *sampling.first()?;
    let are_all_full = sampling.iter().all(|one| *one == first);
    let are_reduced = sampling.iter().all(|one| (0..2).all(|axis| first[axis].is_multiple_of(one[axis])));
    // In libjpeg, JFIF is always YCbCr, and the names of the components tell it without a marker of Adobe.
    let is_named_rgb = components.iter().map(|one| one.id).eq(*b"RGB");
    let is_rgb = decoder.jpeg_color_space() == ColorSpace::Rgb;
    match components.len() {
        3 if is_rgb && decoder.saw_jfif_marker() => Some("JFIF whose marker of Adobe says RGB"),
        3 if is_named_rgb && !is_rgb => Some("RGB without the marker of Adobe"),
        3 if is_rgb && !are_all_full => Some("RGB with subsampled components"),
        3 if !are_reduced => Some("YCbCr with chroma that is larger than luma"),
        _ => None,
    }
}

/// Whether the end of the image is there: libjpeg-turbo-rs 0.8.0 fills what is missing of a single scan with gray, without a word.
fn is_whole(bytes: &[u8]) -> bool {
    const END: u8 = 0xd9;
    let mut at = 2;
    loop {
        // A marker: any number of 255, then its code; in the data of a scan 255 is followed by 0, or by a restart of 208 to 215.
        let Some(next) = bytes.get(at..).and_then(|rest| rest.iter().position(|byte| *byte == 0xff)) else {
            return false;
        };
        let Some((marker, rest)) = bytes[at + next + 1..].split_first() else { return false };
        at += next + 1;
        match *marker {
            END => return true,
            0 | 0x01 | 0xd0..=0xd8 => at += 1,
            0xff => {}
            _ => {
                let [high, low, ..] = rest else { return false };
                let length = usize::from(u16::from_be_bytes([*high, *low]));
                at += 1 + length.max(2);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use std::io::Cursor;
    use std::path::Path;

    use base64::Engine as _;
    use base64::engine::general_purpose::STANDARD;

    use super::*;
    use crate::read::decode::reader;
    use crate::read::record::Subject;

    /// A picture of 10 x 7 pixels, 4:2:0, that Pillow 13.0 has written and read with libjpeg-turbo 3.2: the file, and its values.
    const OF_PILLOW: [&str; 2] = [
        "/9j/4AAQSkZJRgABAQAAAQABAAD/2wBDAAYEBQYFBAYGBQYHBwYIChAKCgkJChQODwwQFxQYGBcUFhYaHSUfGhsjHBYWICwgIyYnKSopGR8tMC0oMCUoKSj/2wBDAQcHBwoIChMKChMoGhYaKCgoKCgoKCgoKCgoKCgoKCgoKCgoKCgoKCgoKCgoKCgoKCgoKCgoKCgoKCgoKCgoKCj/wAARCAAHAAoDASIAAhEBAxEB/8QAFgABAQEAAAAAAAAAAAAAAAAAAAMF/8QAIhAAAQMDBAMBAAAAAAAAAAAAAQIDBQAGEgQRIWETMTJS/8QAFQEBAQAAAAAAAAAAAAAAAAAABQb/xAAiEQABAgMJAAAAAAAAAAAAAAABAgMABRESEyIxQVFxgcH/2gAMAwEAAhEDEQA/ANCBgJbQ29q3zFwah48NsFj6IT++6iqyrqeUXUSTLKVnINNstYoB5xG4J2Hrkk90pR775YduWwAmleySPInVzBaS2LKTgGYrqd+I/9k=",
        "BFMAI1wATlsAdWkXhm00jYhqe6SmI250MJCEN6GKMYY1Tos7eIk5oJNPspdqvLGdpsfOWJahYq2mVKeVTq1za7J6mK97xbeQ3byr8djb1uP0nb7RqM7REzo1AEEgA0YnMkQsXkxAe1JYj29+X2h3NVJaJUA7LEY7FV5XMGJfX2NmhGh2nmyHp4abWGtpN2RQUn9gY5FsP42NW5KVipair5ywyaK/zLzHY5BvTJpeT5xYgs+HUrutbcC4ncfGw83W3tXm4vToaMByXNhobul3j/+W",
    ];

    fn decoded(bytes: &[u8]) -> Result<Decoded, Error> {
        let place = DecodedFile::of(Path::new("m.jpg"), Subject::Material);
        decode(reader(Cursor::new(bytes)), DecodedFile { length: bytes.len() as u64, ..place })
    }

    #[test]
    fn values_are_those_of_libjpeg_turbo() {
        let [file, values] = OF_PILLOW.map(|text| STANDARD.decode(text).unwrap());
        let raster = decoded(&file).unwrap().layers.remove(0).raster;
        assert_eq!(raster, Raster::with_alpha(10, 7, "8-bit", Samples::interleaved(values, 3)));
        for cut in [1, 2, 20, file.len() / 3] {
            let refused = decoded(&file[..file.len() - cut]).unwrap_err().to_string();
            assert!(refused.contains("m.jpg"), "without its last {cut} bytes: {refused}");
        }
        assert!(decoded(&[file, b"and more".to_vec()].concat()).is_ok(), "with more behind it");
    }

    /// The marker of Adobe, as `tiff_jpeg` writes it, which says RGB.
    const ADOBE: &[u8] = b"\xff\xee\0\x0eAdobe\0\x64\0\0\0\0\0";
    const YCBCR: &[u8] = b"\x01\x22\0\x02\x11\x01\x03\x11\x01";

    #[test]
    fn what_has_other_values_in_libjpeg_turbo_is_refused() {
        let jfif = STANDARD.decode(OF_PILLOW[0]).unwrap();
        let after = |header: &[u8], rest: &[u8]| [&jfif[..2], header, rest].concat();
        let with = |file: &[u8], changes: &[(&[u8], &[u8])]| {
            changes.iter().fold(file.to_vec(), |mut file, (from, to)| {
                let at = file.windows(from.len()).position(|part| part == *from).unwrap();
                file[at..at + from.len()].copy_from_slice(to);
                file
            })
        };
        let rgb = (YCBCR, b"R\x22\0G\x11\x01B\x11\x01".as_slice());
        let scan = (b"\x03\x01\0\x02\x11\x03\x11".as_slice(), b"\x03R\0G\x11B\x11".as_slice());
        let large = (YCBCR, b"\x01\x11\0\x02\x22\x01\x03\x22\x01".as_slice());
        for (file, found) in [
            (after(ADOBE, &jfif[20..]), "RGB with subsampled components"),
            (after(ADOBE, &jfif[2..]), "JFIF whose marker of Adobe says RGB"),
            (with(&after(&[], &jfif[20..]), &[rgb, scan]), "RGB without the marker of Adobe"),
            (with(&jfif, &[large]), "YCbCr with chroma that is larger than luma"),
        ] {
            let refused = decoded(&file).unwrap_err().to_string();
            assert!(refused.contains(found) && refused.contains("convert it to PNG in RGB"), "{refused}");
        }
    }
}
