//! DDS: blocks (BC1 to BC7) and formats of DXGI through the `dds` library, pixels of masks here; the first surface, the largest level.

use std::io::{BufRead as _, ErrorKind, Read as _, Seek as _, SeekFrom};

use dds::header::{AlphaMode, Header};
use dds::{Channels, ColorFormat, DecodingError, Format, ImageViewMut, Precision};

use super::place::{ByteReader, Decoded, DecodedFile, alone, ratio};
use crate::disk::caught;
use crate::error::Error;
use crate::read::raster::{Buffer, Raster, Samples};
use crate::read::record::Note;

pub(crate) fn decode(mut reader: ByteReader<'_>, place: DecodedFile<'_>) -> Result<Decoded, Error> {
    let head = reader.fill_buf().map_err(|error| Error::unreadable(place.path, error))?;
    if let Some(masks) = Masks::of(head) {
        return masks.decode(reader, place).map(alone);
    }
    let contradiction = |_| place.invalid("DDS", "a contradiction in it");
    let mut decoder =
        caught(|| dds::Decoder::new(reader)).map_err(contradiction)?.map_err(|e| explain(&e, place))?;
    if !decoder.layout().is_texture() {
        return Err(several(place));
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
        return Ok(alone(Raster { width, height, depth, channels, alpha: None, to_rec709: None }));
    }
    let raster = Raster::with_alpha(width, height, depth, channels);
    // The library itself divides what DXT2 and DXT4 hold.
    let Header::Dx10(header) = decoder.header() else { return Ok(alone(raster)) };
    Ok(match header.alpha_mode {
        AlphaMode::Opaque => alone(Raster { alpha: None, ..raster }),
        AlphaMode::Premultiplied => {
            let notes = vec![Note::Unmultiplied(place.what)];
            Decoded { notes, ..alone(raster.unmultiplied()) }
        }
        _ => alone(raster),
    })
}

fn several(place: DecodedFile<'_>) -> Error {
    let problem = "expected one picture, found a DDS of a cube map, a volume or several pictures";
    place.bad(problem, "save the map by itself")
}

/// Pixels whose header has a mask of bits for each channel.
struct Masks {
    size: [u32; 2],
    is_one: bool,
    bytes: usize,
    masks: Vec<u32>,
}

impl Masks {
    const HEAD: usize = 128;

    /// `None` of blocks and formats of DXGI, of signed pixels, and of none at all.
    fn of(head: &[u8]) -> Option<Self> {
        const ALPHA: u32 = 3;
        const FOUR_LETTERS: u32 = 4;
        const COLOURS: u32 = 0x40 | 0x2_0000;
        const SEVERAL: u32 = 0x20_fe00;
        let field = |at: usize| Some(u32::from_le_bytes(*head.get(..Self::HEAD)?[at..].first_chunk()?));
        let (flags, bits) = (field(80)?, field(88)?);
        let known = FOUR_LETTERS | COLOURS | ALPHA;
        let is_whole = field(4)? == 124 && field(76)? == 32;
        if flags & FOUR_LETTERS != 0 || flags & !known != 0 || !matches!(bits, 8 | 16 | 24 | 32) || !is_whole
        {
            return None;
        }
        let mut masks = Vec::new();
        for at in [92, 96, 100].into_iter().filter(|_| flags & COLOURS != 0) {
            masks.extend(Some(field(at)?).filter(|mask| *mask != 0 && !masks.contains(mask)));
        }
        masks.extend(Some(field(104)?).filter(|mask| flags & ALPHA != 0 && *mask != 0));
        let is_one = field(112)? & SEVERAL == 0;
        let size = [field(16)?, field(12)?];
        (!masks.is_empty()).then_some(Self { size, is_one, bytes: bits as usize / 8, masks })
    }

    fn decode(&self, mut reader: ByteReader<'_>, place: DecodedFile<'_>) -> Result<Raster, Error> {
        if !self.is_one {
            return Err(several(place));
        }
        let [width, height] = self.size.map(u64::from);
        let bytes = width.saturating_mul(height).saturating_mul(4 * self.masks.len() as u64);
        let _reserved = place.check_size([width, height], bytes, ratio::DDS)?;
        let (width, height) = (width as usize, height as usize);
        let unreadable = |error| Error::unreadable(place.path, error);
        let mut pixels = Vec::new();
        reader.seek(SeekFrom::Start(Self::HEAD as u64)).map_err(unreadable)?;
        let length = width * height * self.bytes;
        reader.take(length as u64).read_to_end(&mut pixels).map_err(unreadable)?;
        if pixels.len() < length {
            return Err(place.truncated());
        }
        let value = |bytes: &[u8], mask: u32, top: u64| {
            let pixel = bytes.iter().rev().fold(0, |sum, byte| sum << 8 | u32::from(*byte));
            let (stored, most) = ((pixel & mask) >> mask.trailing_zeros(), mask >> mask.trailing_zeros());
            (u64::from(stored) * top + u64::from(most) / 2) / u64::from(most)
        };
        let samples = |top: u64| {
            let texels = pixels.chunks_exact(self.bytes);
            texels.flat_map(move |texel| self.masks.iter().map(move |mask| value(texel, *mask, top)))
        };
        let (buffer, depth) = match self.masks.iter().all(|mask| mask.count_ones() <= 8) {
            true => (samples(255).map(|value| value as u8).collect::<Vec<_>>().into(), "8-bit"),
            false => (samples(65_535).map(|value| value as u16).collect::<Vec<_>>().into(), "16-bit"),
        };
        let buffer: Buffer = buffer;
        Ok(place.raster([width, height], depth, Samples::interleaved(buffer, self.masks.len())))
    }
}

/// The pixels of the first surface.
fn pixels<S: bytemuck::Pod>(
    decoder: &mut dds::Decoder<ByteReader<'_>>,
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
