//! From an image file to the codes that it stores. What they mean is the matter of `encoding`.

use std::fs::File;
use std::io::{BufRead, BufReader, ErrorKind, Seek};
use std::path::Path;

use image::error::{ImageError, LimitErrorKind};
use image::{DynamicImage, ImageDecoder, ImageFormat, ImageReader, Limits};

use crate::error::Error;

/// Largest height of an image, so largest side of a map: the largest that material libraries publish.
const MAX_HEIGHT: u32 = 16_384;
/// Largest width of an image: a strip of four of the largest maps.
const MAX_WIDTH: u32 = 4 * MAX_HEIGHT;
/// Most bytes that an image may decode to: a strip of the largest size takes 3 GiB in 8-bit RGB.
const MAX_BYTES: u64 = 4 << 30;

/// An image as stored: one plane of codes for each channel, row 0 on top. Alpha is left out.
#[derive(Clone, Debug, PartialEq)]
pub struct Raster {
    pub width: usize,
    pub height: usize,
    /// The code that stands for 1: 255 or 65535.
    pub max: u16,
    /// One plane for gray, three for RGB.
    pub channels: Vec<Vec<u16>>,
    /// Whether the file has an alpha channel that is not opaque everywhere.
    pub transparent: bool,
}

impl Raster {
    /// The square tile number `index` from the left, as wide as the image is high.
    pub fn tile(&self, index: usize) -> Self {
        let side = self.height;
        let crop = |plane: &Vec<u16>| {
            let rows = plane.chunks_exact(self.width);
            rows.flat_map(|row| &row[index * side..(index + 1) * side]).copied().collect()
        };
        Self { width: side, channels: self.channels.iter().map(crop).collect(), ..*self }
    }
}

/// Decodes the image in the file `path`, which is to be `what`, as in "normal map".
///
/// # Errors
/// [`Error::Unreadable`] without such a file, [`Error::BadImage`] where it is no image, broken or too large.
pub fn decode_file(path: &Path, what: &str) -> Result<Raster, Error> {
    let file = File::open(path).map_err(|source| Error::unreadable(path, source))?;
    decode(BufReader::new(file), path, what)
}

/// As [`decode_file`], from what `reader` gives; `path` is the name for messages.
pub fn decode(reader: impl BufRead + Seek, path: &Path, what: &str) -> Result<Raster, Error> {
    let bad = |problem: String, remedy: &str| Error::BadImage {
        path: path.to_owned(),
        problem: format!("{what}: {problem}"),
        remedy: remedy.to_owned(),
    };
    let broken = |error: ImageError| {
        let (problem, remedy) = explain(&error);
        bad(problem, remedy)
    };

    let mut reader =
        ImageReader::new(reader).with_guessed_format().map_err(|source| Error::unreadable(path, source))?;
    match reader.format() {
        Some(ImageFormat::Png) => (),
        Some(other) => {
            return Err(bad(format!("expected PNG, found {other:?}"), "convert it to PNG"));
        }
        None => return Err(bad("expected PNG, found no known image format".to_owned(), "give a PNG file")),
    }
    reader.limits(limits());
    let decoder = reader.into_decoder().map_err(broken)?;
    let (width, height) = decoder.dimensions();
    if width > MAX_WIDTH || height > MAX_HEIGHT || decoder.total_bytes() > MAX_BYTES {
        let problem = format!(
            "expected at most {MAX_WIDTH} x {MAX_HEIGHT} pixels and {} GiB, found {width} x {height}",
            MAX_BYTES >> 30
        );
        return Err(bad(problem, "scale it down"));
    }
    let image = DynamicImage::from_decoder(decoder).map_err(broken)?;
    let found = image.color();
    raster(image).ok_or_else(|| bad(format!("expected 8 or 16 bits, found {found:?}"), "convert it"))
}

/// What the decoder may allocate. The size of the image is checked apart, for a message with numbers.
fn limits() -> Limits {
    let mut limits = Limits::no_limits();
    limits.max_alloc = Some(MAX_BYTES);
    limits
}

/// What is wrong with a file that begins like a PNG, and what to do.
fn explain(error: &ImageError) -> (String, &'static str) {
    match error {
        ImageError::IoError(io) if io.kind() == ErrorKind::UnexpectedEof => (
            "expected the whole image, found the end of the file within it".to_owned(),
            "copy the file again",
        ),
        ImageError::Limits(limit) if matches!(limit.kind(), LimitErrorKind::InsufficientMemory) => {
            (format!("expected at most {} GiB of pixels, found more", MAX_BYTES >> 30), "scale it down")
        }
        other => (format!("expected a valid PNG, found: {other}"), "write the file again"),
    }
}

/// `None` for kinds of pixels that PNG does not have.
fn raster(image: DynamicImage) -> Option<Raster> {
    let (width, height) = (image.width() as usize, image.height() as usize);
    let (channels, max, alpha) = match image {
        DynamicImage::ImageLuma8(i) => (planes::<1, _>(&i.into_raw()), u16::from(u8::MAX), false),
        DynamicImage::ImageLumaA8(i) => (planes::<2, _>(&i.into_raw()), u16::from(u8::MAX), true),
        DynamicImage::ImageRgb8(i) => (planes::<3, _>(&i.into_raw()), u16::from(u8::MAX), false),
        DynamicImage::ImageRgba8(i) => (planes::<4, _>(&i.into_raw()), u16::from(u8::MAX), true),
        DynamicImage::ImageLuma16(i) => (planes::<1, _>(&i.into_raw()), u16::MAX, false),
        DynamicImage::ImageLumaA16(i) => (planes::<2, _>(&i.into_raw()), u16::MAX, true),
        DynamicImage::ImageRgb16(i) => (planes::<3, _>(&i.into_raw()), u16::MAX, false),
        DynamicImage::ImageRgba16(i) => (planes::<4, _>(&i.into_raw()), u16::MAX, true),
        _ => return None,
    };
    let mut channels = channels;
    let alpha = if alpha { channels.pop() } else { None };
    let transparent = alpha.is_some_and(|plane| plane.iter().any(|&code| code != max));
    Some(Raster { width, height, max, channels, transparent })
}

/// Takes pixels of `N` interleaved samples apart.
fn planes<const N: usize, S: Copy + Into<u16>>(samples: &[S]) -> Vec<Vec<u16>> {
    (0..N).map(|channel| samples.iter().skip(channel).step_by(N).map(|&s| s.into()).collect()).collect()
}
