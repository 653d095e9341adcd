//! PNG, JPEG and HDR through the `image` library. Colour chunks are left alone, palettes and few bits expanded.

use std::io::{BufRead, ErrorKind, Seek};

use image::error::{ImageError, LimitErrorKind};
use image::{DynamicImage, ImageDecoder, ImageFormat, ImageReader, Limits};

use super::{FORMATS, MAX_BYTES, Place, planes};
use crate::error::Error;
use crate::material::read::raster::{Raster, Samples};

pub(super) fn decode(reader: impl BufRead + Seek, place: Place<'_>) -> Result<Raster, Error> {
    let mut reader =
        ImageReader::new(reader).with_guessed_format().map_err(|e| Error::unreadable(place.path, e))?;
    let format = match reader.format() {
        Some(ImageFormat::Png) => "PNG",
        Some(ImageFormat::Jpeg) => "JPEG",
        Some(ImageFormat::Hdr) => "HDR",
        Some(other) => {
            return Err(place.bad(format!("expected {FORMATS}, found {other:?}"), "convert it to PNG"));
        }
        None => {
            return Err(
                place.bad(format!("expected {FORMATS}, found no known image format"), "give a PNG file")
            );
        }
    };
    reader.limits(limits());
    let broken = |error: ImageError| explain(&error, format, place);
    let decoder = reader.into_decoder().map_err(broken)?;
    let (width, height) = decoder.dimensions();
    place.check_size(width.into(), height.into(), decoder.total_bytes())?;
    let image = DynamicImage::from_decoder(decoder).map_err(broken)?;
    let found = image.color();
    raster(image).ok_or_else(|| place.bad(format!("expected 8 or 16 bits, found {found:?}"), "convert it"))
}

/// What the decoder may allocate. The size of the image is checked apart, for a message with numbers.
fn limits() -> Limits {
    let mut limits = Limits::no_limits();
    limits.max_alloc = Some(MAX_BYTES);
    limits
}

fn explain(error: &ImageError, format: &str, place: Place<'_>) -> Error {
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
fn raster(image: DynamicImage) -> Option<Raster> {
    let (width, height) = (image.width() as usize, image.height() as usize);
    let (channels, depth) = match image {
        DynamicImage::ImageLuma8(i) => (codes8(&i.into_raw(), 1), "8-bit"),
        DynamicImage::ImageLumaA8(i) => (codes8(&i.into_raw(), 2), "8-bit"),
        DynamicImage::ImageRgb8(i) => (codes8(&i.into_raw(), 3), "8-bit"),
        DynamicImage::ImageRgba8(i) => (codes8(&i.into_raw(), 4), "8-bit"),
        DynamicImage::ImageLuma16(i) => (codes16(&i.into_raw(), 1), "16-bit"),
        DynamicImage::ImageLumaA16(i) => (codes16(&i.into_raw(), 2), "16-bit"),
        DynamicImage::ImageRgb16(i) => (codes16(&i.into_raw(), 3), "16-bit"),
        DynamicImage::ImageRgba16(i) => (codes16(&i.into_raw(), 4), "16-bit"),
        DynamicImage::ImageRgb32F(i) => {
            (planes(&i.into_raw(), 3, |s| s).into_iter().map(Samples::Floats).collect(), "float")
        }
        _ => return None,
    };
    Some(Raster::with_alpha(width, height, depth, channels))
}

fn codes8(samples: &[u8], count: usize) -> Vec<Samples> {
    let planes = planes(samples, count, u16::from).into_iter();
    planes.map(|codes| Samples::Codes { codes, max: u8::MAX.into() }).collect()
}

fn codes16(samples: &[u16], count: usize) -> Vec<Samples> {
    planes(samples, count, |s| s).into_iter().map(|codes| Samples::Codes { codes, max: u16::MAX }).collect()
}
