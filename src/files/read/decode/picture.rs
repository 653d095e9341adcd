//! PNG, BMP, TGA, WebP, PNM, QOI and HDR through the `image` library. Colour chunks are left alone, palettes and few bits expanded.

use std::io;
use std::io::{BufRead as _, ErrorKind, Read as _, Seek as _};

use image::codecs::bmp::BmpDecoder;
use image::codecs::hdr::HdrDecoder;
use image::codecs::png::PngDecoder;
use image::codecs::pnm::PnmDecoder;
use image::codecs::qoi::QoiDecoder;
use image::codecs::tga::TgaDecoder;
use image::codecs::webp::WebPDecoder;
use image::error::{ImageError, LimitErrorKind};
use image::metadata::Orientation;
use image::{DynamicImage, ImageDecoder, ImageFormat, Limits};

use super::place::{ByteReader, Decoded, DecodedFile, FORMATS, MAX_BYTES, MAX_WIDTH, alone, ratio};
use super::{jpeg, known};
use crate::disk::caught;
use crate::error::Error;
use crate::read::raster::{Raster, Samples};
use crate::read::record::Note;

/// Most bytes of the metadata of a PNG: an ICC profile of a printer has some megabytes.
const MAX_METADATA: u64 = 64 << 20;

pub(crate) fn decode(mut reader: ByteReader<'_>, place: DecodedFile<'_>) -> Result<Decoded, Error> {
    let unreadable = |e| Error::unreadable(place.path, e);
    let head = reader.fill_buf().map_err(unreadable)?;
    match image::guess_format(head) {
        Ok(ImageFormat::Png) => png(reader, place),
        Ok(ImageFormat::Jpeg) if known::name(head).is_none() => jpeg::decode(reader, place),
        Ok(ImageFormat::Hdr) => hdr(reader, place),
        Ok(ImageFormat::Bmp) => {
            // Compression 1 and 2.
            let is_in_runs = matches!(head.get(30), Some(1 | 2));
            let most = if is_in_runs { ratio::NONE } else { ratio::BMP };
            let decoder = BmpDecoder::new(reader).map_err(|error| explain(&error, "BMP", place))?;
            decode_with(Box::new(decoder), "BMP", most, place)
        }
        Ok(ImageFormat::Pnm) => {
            // Without it, the library takes every sample for one byte.
            if head.starts_with(b"P7") && !head.windows(8).any(|word| word == b"TUPLTYPE") {
                return Err(
                    place.bad("expected a PAM with its TUPLTYPE, found none", "save it as PPM or PGM")
                );
            }
            let decoder = PnmDecoder::new(reader).map_err(|error| explain(&error, "PNM", place))?;
            decode_with(Box::new(decoder), "PNM", ratio::PNM, place)
        }
        Ok(ImageFormat::Qoi) => {
            // All channels are linear by its header.
            let is_linear = head.get(13) == Some(&1) && !place.is_data();
            let decoder = QoiDecoder::new(reader).map_err(|error| explain(&error, "QOI", place))?;
            let mut decoded = decode_with(Box::new(decoder), "QOI", ratio::QOI, place)?;
            decoded.notes.extend(is_linear.then_some(Note::LinearChunk(place.what, "QOI header")));
            Ok(decoded)
        }
        Ok(ImageFormat::WebP) => {
            let most = if head.get(12..16) == Some(b"VP8 ") { ratio::LOSSY_WEBP } else { ratio::NONE };
            let decoder = WebPDecoder::new(reader).map_err(|error| explain(&error, "WebP", place))?;
            let is_animated = decoder.has_animation();
            let mut decoded = decode_with(Box::new(decoder), "WebP", most, place)?;
            decoded.notes.extend(is_animated.then_some(Note::FirstOnly(place.what)));
            Ok(decoded)
        }
        _ if known::name(head).is_none() && is_tga(place) => {
            let decoder = TgaDecoder::new(reader).map_err(|error| explain(&error, "TGA", place))?;
            decode_with(Box::new(decoder), "TGA", ratio::TGA, place)
        }
        other => {
            let other = other.ok().map(|format| (format!("{format:?}"), "convert it to PNG"));
            Err(match known::name(head).map(|(name, remedy)| (name.to_owned(), remedy)).or(other) {
                Some((found, remedy)) => place.bad(format!("expected {FORMATS}, found {found}"), remedy),
                None if head.is_empty() => {
                    place.bad("expected an image, found an empty file", "copy or save it again")
                }
                None => {
                    place.bad(format!("expected {FORMATS}, found no known image format"), "give a PNG file")
                }
            })
        }
    }
}

fn png(mut reader: ByteReader<'_>, place: DecodedFile<'_>) -> Result<Decoded, Error> {
    let unreadable = |e| Error::unreadable(place.path, e);
    let head = reader.fill_buf().map_err(unreadable)?;
    // A row of it counts as metadata, too.
    let width = head.get(16..20).and_then(|bytes| bytes.try_into().ok()).map_or(0, u32::from_be_bytes);
    let is_too_wide = width as usize > MAX_WIDTH;
    let PngHead { linear, other_primaries, is_animated, meaning } = png_head(&mut reader).unwrap_or_default();
    reader.rewind().map_err(unreadable)?;
    let decoder = PngDecoder::with_limits(reader, metadata_limits())
        .map_err(|e| of_metadata(&e, is_too_wide, place))?;
    let mut decoded = decode_with(Box::new(decoder), "PNG", ratio::PNG, place)?;
    decoded.notes.extend(is_animated.then_some(Note::FirstOnly(place.what)));
    if !place.is_data() {
        decoded.notes.extend(linear.map(|chunk| Note::LinearChunk(place.what, chunk)));
        decoded.notes.extend(other_primaries.map(|chunk| Note::PrimariesChunk(place.what, chunk)));
    }
    decoded.layers.iter_mut().for_each(|layer| layer.meaning.clone_from(&meaning));
    Ok(decoded)
}

/// By its name: a TGA begins with nothing of its own.
fn is_tga(place: DecodedFile<'_>) -> bool {
    place.path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("tga"))
}

fn decode_with(
    mut decoder: Box<dyn ImageDecoder + '_>,
    format: &str,
    ratio: u64,
    place: DecodedFile<'_>,
) -> Result<Decoded, Error> {
    let broken = |error: ImageError| explain(&error, format, place);
    decoder.set_limits(limits()).map_err(broken)?;
    let (width, height) = decoder.dimensions();
    let _reserved = place.check_size([width.into(), height.into()], decoder.total_bytes(), ratio)?;
    let orientation = decoder.orientation().unwrap_or(Orientation::NoTransforms).to_exif();
    let notes = place.metadata_notes(orientation, decoder.icc_profile().ok().flatten().as_deref());
    let image = caught(|| DynamicImage::from_decoder(decoder))
        .map_err(|_| place.invalid(format, "a contradiction in it"))?
        .map_err(broken)?;
    let found = image.color();
    let raster = raster(image, place)
        .ok_or_else(|| place.bad(format!("expected 8 or 16 bits, found {found:?}"), "convert it"))?;
    let raster = if place.is_photograph() { raster.oriented(orientation.into()) } else { raster };
    Ok(Decoded { notes, ..alone(raster) })
}

/// The most that the decoder may allocate. The size of the image is checked apart, for a message with numbers.
fn limits() -> Limits {
    let mut limits = Limits::no_limits();
    limits.max_alloc = Some(MAX_BYTES);
    limits
}

/// The most that profiles and texts of a PNG may unpack to.
fn metadata_limits() -> Limits {
    let mut limits = Limits::no_limits();
    limits.max_alloc = Some(MAX_METADATA);
    limits
}

/// The error of a PNG whose head cannot be read.
fn of_metadata(error: &ImageError, is_too_wide: bool, place: DecodedFile<'_>) -> Error {
    match error {
        ImageError::Limits(_) if !is_too_wide => {
            let problem =
                format!("expected at most {} MiB of profiles and texts, found more", MAX_METADATA >> 20);
            place.bad(problem, "save it without them")
        }
        other => explain(other, "PNG", place),
    }
}

fn explain(error: &ImageError, format: &str, place: DecodedFile<'_>) -> Error {
    match error {
        ImageError::IoError(io) if io.kind() == ErrorKind::UnexpectedEof => place.truncated(),
        ImageError::Limits(limit) if matches!(limit.kind(), LimitErrorKind::InsufficientMemory) => {
            let problem = format!("expected at most {} GiB of pixels, found more", MAX_BYTES >> 30);
            place.bad(problem, "scale it down")
        }
        other => place.invalid(format, other),
    }
}

/// `None` for kinds of pixels that are not known.
fn raster(image: DynamicImage, place: DecodedFile<'_>) -> Option<Raster> {
    let (width, height) = (image.width() as usize, image.height() as usize);
    let (channels, depth) = match image {
        DynamicImage::ImageLuma8(i) => (Samples::interleaved(i.into_raw(), 1), "8-bit"),
        DynamicImage::ImageLumaA8(i) => (Samples::interleaved(i.into_raw(), 2), "8-bit"),
        DynamicImage::ImageRgb8(i) => (Samples::interleaved(i.into_raw(), 3), "8-bit"),
        DynamicImage::ImageRgba8(i) => (Samples::interleaved(i.into_raw(), 4), "8-bit"),
        DynamicImage::ImageLuma16(i) => (Samples::interleaved(i.into_raw(), 1), "16-bit"),
        DynamicImage::ImageLumaA16(i) => (Samples::interleaved(i.into_raw(), 2), "16-bit"),
        DynamicImage::ImageRgb16(i) => (Samples::interleaved(i.into_raw(), 3), "16-bit"),
        DynamicImage::ImageRgba16(i) => (Samples::interleaved(i.into_raw(), 4), "16-bit"),
        DynamicImage::ImageRgb32F(i) => (Samples::interleaved(i.into_raw(), 3), "float"),
        _ => return None,
    };
    Some(place.raster([width, height], depth, channels))
}

/// The radiance of an HDR, by whose exposures and corrections its pixels are multiplied, with the primaries that it declares.
fn hdr(mut reader: ByteReader<'_>, place: DecodedFile<'_>) -> Result<Decoded, Error> {
    let unreadable = |e| Error::unreadable(place.path, e);
    if !is_hdr_head_short(&mut reader).map_err(unreadable)? {
        let problem = format!("expected an HDR whose header ends within {} KiB", LONGEST_HDR >> 10);
        return Err(place.bad(problem, "save it with another program"));
    }
    reader.rewind().map_err(unreadable)?;
    let decoder = HdrDecoder::new(reader).map_err(|error| explain(&error, "HDR", place))?;
    let metadata = decoder.metadata();
    let mut decoded = decode_with(Box::new(decoder), "HDR", ratio::HDR, place)?;
    let (red, green, blue) = metadata.color_correction.unwrap_or((1.0, 1.0, 1.0));
    let factors = [red, green, blue].map(|factor| (factor * metadata.exposure.unwrap_or(1.0)).recip());
    let is_usable = factors.iter().all(|factor| factor.is_finite() && *factor > 0.0);
    let primaries = metadata.custom_attributes.iter().find(|(name, _)| name == "PRIMARIES");
    let numbers = primaries.map(|(_, text)| text.split_whitespace().filter_map(|one| one.parse().ok()));
    let numbers: Vec<f64> = numbers.into_iter().flatten().collect();
    let of_primaries = match numbers.as_chunks::<2>() {
        (&[red, green, blue, white], []) => place.to_rec709([red, green, blue, white], &mut decoded.notes),
        _ => None,
    };
    for layer in &mut decoded.layers {
        layer.raster.to_rec709 = of_primaries;
        if is_usable {
            layer.raster = layer.raster.clone().scaled(&factors);
        }
    }
    Ok(decoded)
}

/// Most bytes of the header of an HDR.
const LONGEST_HDR: u64 = 64 << 10;

/// Whether the header of an HDR, an empty line and the line of the resolution at its end, is at most [`LONGEST_HDR`] long, or else
/// the file: the library reads it to an end that may never come.
fn is_hdr_head_short(reader: &mut ByteReader<'_>) -> io::Result<bool> {
    let mut head = Vec::new();
    reader.take(LONGEST_HDR).read_to_end(&mut head)?;
    let end = head.windows(2).position(|two| two == b"\n\n");
    let has_resolution = end.is_some_and(|end| head[end + 2..].contains(&b'\n'));
    Ok(has_resolution || (head.len() as u64) < LONGEST_HDR)
}

/// The fields of a PNG before its pixels.
#[derive(Default)]
struct PngHead {
    /// The chunk that declares its values linear: cICP, or else gAMA without sRGB.
    linear: Option<&'static str>,
    /// The chunk that declares primaries other than those of Rec. 709: cICP, or else cHRM without sRGB.
    other_primaries: Option<&'static str>,
    is_animated: bool,
    /// The text that this program writes into its pictures: their order and encoding.
    meaning: Option<String>,
}

/// The code of linear values in cICP (ITU-T H.273).
const LINEAR: u8 = 8;
/// The chromaticities of red, green and blue of Rec. 709, in 1/100000.
const REC709: [[u32; 2]; 3] = [[64_000, 33_000], [30_000, 60_000], [15_000, 6_000]];

fn png_head(reader: &mut ByteReader<'_>) -> Option<PngHead> {
    let opened = png::Decoder::new(reader).read_info().ok()?;
    let info = opened.info();
    let has_no_srgb = info.srgb.is_none();
    let cicp = info.coding_independent_code_points;
    let linear = match cicp {
        Some(points) => (points.transfer_function == LINEAR).then_some("cICP chunk"),
        None => {
            let is_one = info.gama_chunk.is_some_and(|gamma| gamma.into_scaled().abs_diff(100_000) < 1000);
            (is_one && has_no_srgb).then_some("gAMA chunk")
        }
    };
    let other_primaries = match cicp {
        // 2 are not specified.
        Some(points) => (!matches!(points.color_primaries, 1 | 2)).then_some("cICP chunk"),
        None => {
            let is_other = info.chrm_chunk.is_some_and(|of| {
                let found = [of.red, of.green, of.blue].map(|(x, y)| [x, y].map(|part| part.into_scaled()));
                found.as_flattened().iter().zip(REC709.as_flattened()).any(|(a, b)| a.abs_diff(*b) > 1000)
            });
            (is_other && has_no_srgb).then_some("cHRM chunk")
        }
    };
    let is_animated = info.animation_control.is_some_and(|control| control.num_frames > 1);
    let written = info.uncompressed_latin1_text.iter().rev().find(|text| text.keyword == "svbrdf");
    Some(PngHead { linear, other_primaries, is_animated, meaning: written.map(|text| text.text.clone()) })
}
