//! DDS through the `dds` library: blocks (BC1 to BC7) and plain pixels; the first surface, the largest level.

use std::io::ErrorKind;

use dds::header::{Dx9Header, Dx9PixelFormat, Header, PixelFormatFlags};
use dds::{Channels, ColorFormat, DecodingError, Format, ImageViewMut, Precision};

use super::place::{DecodedFile, ratio};
use super::reader::Reader;
use crate::disk::caught;
use crate::error::Error;
use crate::read::options::Role;
use crate::read::raster::{Buffer, Raster, Samples};
use crate::read::record::Subject;

pub(crate) fn decode(reader: Reader<'_>, place: DecodedFile<'_>) -> Result<Raster, Error> {
    let contradiction = |_| place.invalid("DDS", "a contradiction in it");
    let mut decoder =
        caught(|| dds::Decoder::new(reader)).map_err(contradiction)?.map_err(|e| explain(&e, place))?;
    if !decoder.layout().is_texture() {
        let problem = "expected one picture, found a DDS of a cube map, a volume or several pictures";
        return Err(place.bad(problem, "save the map by itself"));
    }
    if is_signed(decoder.format()) {
        let problem = format!("expected unsigned samples, found a DDS in {:?}", decoder.format());
        return Err(place.bad(problem, "convert it to PNG"));
    }
    let size = decoder.main_size();
    let native = decoder.native_color();
    let (channels, count) = match native.channels {
        Channels::Grayscale => (Channels::Grayscale, 1),
        Channels::Rgb => (Channels::Rgb, 3),
        Channels::Alpha => (Channels::Alpha, 1),
        Channels::Rgba => (Channels::Rgba, 4),
    };
    let texels = u64::from(size.width).saturating_mul(u64::from(size.height));
    let bytes = texels.saturating_mul(4 * count as u64);
    let _reserved = place.check_size([size.width.into(), size.height.into()], bytes, ratio::DDS)?;
    let values = texels as usize * count;
    let format = ColorFormat::new(channels, native.precision);
    let (buffer, depth) = match native.precision {
        Precision::U8 => (pixels(&mut decoder, vec![0_u8; values], format, place)?, "8-bit"),
        Precision::U16 => (pixels(&mut decoder, vec![0_u16; values], format, place)?, "16-bit"),
        Precision::F32 => (pixels(&mut decoder, vec![0.0_f32; values], format, place)?, "float"),
    };
    let mut channels = Samples::interleaved(buffer, count);
    let (width, height) = (size.width as usize, size.height as usize);
    if is_two_channel(decoder.format()) {
        channels.truncate(2);
        // Gray and alpha; but writers of x and y claim that, too.
        let is_gray = is_luminance(decoder.header()) && place.what != Subject::Map(Role::Normal);
        if !is_gray {
            return Ok(Raster { width, height, depth, channels, alpha: None, to_rec709: None });
        }
    }
    Ok(Raster::with_alpha(width, height, depth, channels))
}

/// The pixels of the first surface.
fn pixels<S: bytemuck::Pod>(
    decoder: &mut dds::Decoder<Reader<'_>>,
    mut samples: Vec<S>,
    format: ColorFormat,
    place: DecodedFile<'_>,
) -> Result<Buffer, Error>
where
    Buffer: From<Vec<S>>,
{
    let invalid = || place.invalid("DDS", "a contradiction in its size");
    let view = ImageViewMut::new(bytemuck::cast_slice_mut(&mut samples), decoder.main_size(), format)
        .ok_or_else(invalid)?;
    caught(|| decoder.read_surface(view)).map_err(|_| invalid())?.map_err(|e| explain(&e, place))?;
    Ok(samples.into())
}

fn explain(error: &DecodingError, place: DecodedFile<'_>) -> Error {
    match error {
        DecodingError::Io(io) if io.kind() == ErrorKind::UnexpectedEof => place.truncated(),
        other => place.invalid("DDS", other),
    }
}

/// Formats whose samples reach below 0: the library maps them to [0, 1], where nobody would know them again.
fn is_signed(format: Format) -> bool {
    format!("{format:?}").contains("SNORM")
}

/// Formats of x and y alone, as normal maps have; the library adds a third channel.
fn is_two_channel(format: Format) -> bool {
    use Format as F;
    matches!(format, F::BC5_UNORM | F::R8G8_UNORM | F::R16G16_UNORM | F::R16G16_FLOAT | F::R32G32_FLOAT)
}

/// Whether the header claims gray and alpha.
fn is_luminance(header: &Header) -> bool {
    let Header::Dx9(Dx9Header { pixel_format: Dx9PixelFormat::Mask(mask), .. }) = header else {
        return false;
    };
    mask.flags.contains(PixelFormatFlags::LUMINANCE_ALPHA)
}
