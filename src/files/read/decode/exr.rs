//! EXR through the `exr` library: half, float and uint; any channels, layers and parts; the largest level.

use std::collections::BTreeMap;
use std::io::Seek as _;

use exr::block::chunk::CompressedBlock;
use exr::compression::Compression;
use exr::image::FlatSamples;
use exr::meta::MetaData;
use exr::meta::attribute::{Chromaticities, IntegerBounds, Text};
use exr::meta::header::Header;
use exr::prelude::{AnyChannel, FlatImage, ReadChannels, ReadLayers, read};

use super::place::{ByteReader, Decoded, DecodedFile, Layer, MAX_SIDE, ratio};
use crate::disk::caught;
use crate::error::Error;
use crate::read::names::Label;
use crate::read::options::Role;
use crate::read::raster::{Raster, Samples};
use crate::read::record::{Note, Subject, Unused};

/// The beginning of the comments of an EXR that this program wrote as a material.
pub(crate) const NATIVE: &str = "svbrdf:version=1\n";
/// Blocks of DWA may take so many bytes more than their samples: they are padded to 8 x 8.
const SMALL: u64 = 1 << 20;

/// The channels of one layer: name in capitals, samples.
type NamedSamples = Vec<(String, Samples)>;

pub(crate) fn decode(mut reader: ByteReader<'_>, place: DecodedFile<'_>) -> Result<Decoded, Error> {
    let invalid = |e: exr::error::Error| match e {
        exr::error::Error::Io(io) if io.kind() == std::io::ErrorKind::UnexpectedEof => place.truncated(),
        exr::error::Error::NotSupported(what) if what.contains("compression") => place.bad(
            format!("expected a compression that is read, found: {what}"),
            "save it with another compression, such as ZIP or PIZ",
        ),
        other => place.invalid("EXR", other),
    };
    let meta = MetaData::read_from_buffered(&mut reader, false).map_err(invalid)?;
    let bytes = check(&meta, place)?;
    let _reserved = place.reserve(bytes)?;
    reader.rewind().map_err(|e| Error::unreadable(place.path, e))?;
    caught(|| check_dwa(&mut reader, &meta, bytes + SMALL))
        .map_err(|_| place.invalid("EXR", "a contradiction in its blocks"))?
        .map_err(invalid)?;
    let reading = || {
        let reading = read().no_deep_data().largest_resolution_level().all_channels().all_layers();
        reading.all_attributes().non_parallel().from_buffered(&mut reader)
    };
    // exr 1.74.2 panics at some damaged files, found by damaging many. On threads of its own that would end the
    // program: so it gets none.
    let image = caught(reading)
        .map_err(|_| place.invalid("EXR", "a contradiction in its blocks"))?
        .map_err(invalid)?;
    layers(image, place)
}

/// Refuses what cannot be read; returns how many bytes all samples take, in 32 bits each.
fn check(meta: &MetaData, place: DecodedFile<'_>) -> Result<u64, Error> {
    let mut bytes = 0_u64;
    for header in &meta.headers {
        if header.deep {
            return Err(place.bad("expected flat samples, found a deep EXR", "flatten it first"));
        }
        if header.channels.list.iter().any(|c| c.sampling.0 != 1 || c.sampling.1 != 1) {
            let problem = "expected every channel at full size, found subsampled ones (luminance and chroma)";
            return Err(place.bad(problem, "save it as RGB"));
        }
        let (width, height) = (header.layer_size.0 as u64, header.layer_size.1 as u64);
        let samples = width.saturating_mul(height).saturating_mul(header.channels.list.len() as u64);
        bytes = bytes.saturating_add(samples.saturating_mul(4));
        drop(place.check_size([width, height], bytes, ratio::EXR)?);
    }
    Ok(bytes)
}

fn layers(image: FlatImage, place: DecodedFile<'_>) -> Result<Decoded, Error> {
    let mut decoded = Decoded::default();
    let display = image.attributes.display_window;
    let to_rec709 = image.attributes.chromaticities.and_then(|Chromaticities { red, green, blue, white }| {
        let declared = [red, green, blue, white].map(|one| [one.0, one.1].map(f64::from));
        place.to_rec709(declared, &mut decoded.notes)
    });
    for part in image.layer_data {
        let size = [part.size.0, part.size.1];
        let data = IntegerBounds::new(part.attributes.layer_position, part.size);
        let comments = part.attributes.comments.map(|text| text.to_string()).unwrap_or_default();
        let meaning = comments.starts_with(NATIVE).then(|| NATIVE.to_owned());
        let own = part.attributes.layer_name.map(|name| name.to_string()).unwrap_or_default();
        let mut named: BTreeMap<String, NamedSamples> = BTreeMap::new();
        let mut depth = "half";
        let integers = part.channel_data.list.iter().filter_map(|channel| match &channel.sample_data {
            FlatSamples::U32(values) => values.iter().max().copied(),
            _ => None,
        });
        let most = integers.max().unwrap_or(0);
        for AnyChannel { name, sample_data, .. } in part.channel_data.list {
            let (layer, channel) = split(&own, &name);
            let (samples, found) = samples(sample_data, most);
            depth = if found == "half" { depth } else { found };
            named.entry(layer).or_default().push((channel, samples));
        }
        for (name, channels) in named {
            let is_normal = place.what == Subject::Map(Role::Normal)
                || Label::of(&name).is_some_and(|label| label.role == Role::Normal);
            let Some((mut raster, mut left)) = raster(size, depth, channels, is_normal) else { continue };
            raster.to_rec709 = to_rec709.filter(|_| raster.channels.len() == 3);
            left.sort_by_key(|name| "RGBXYZ".find(name.as_str()));
            if !left.is_empty() {
                let layer = if name.is_empty() { String::new() } else { format!(" of layer {name}") };
                let what = format!("Channel {}{layer}", left.join(", "));
                decoded.notes.push(Note::Unused { what, why: Unused::NotAMap });
            }
            let stored = raster.clone();
            let raster = windowed(raster, data, display, &name, &mut decoded.notes);
            let uncropped = (raster.size() != stored.size()).then_some(stored);
            decoded.layers.push(Layer { name, raster, uncropped, meaning: meaning.clone() });
        }
    }
    if decoded.layers.is_empty() {
        return Err(
            place.bad("expected channels such as R, G, B or Y, found none of them", "rename its channels")
        );
    }
    Ok(decoded)
}

/// `diffuse.R` is channel R of layer `diffuse`; a part's name stands for a missing layer's, and so does a channel that is named after a map.
fn split(part: &str, channel: &Text) -> (String, String) {
    let name = channel.to_string();
    match name.rsplit_once('.') {
        Some((layer, channel)) => (layer.to_owned(), channel.to_uppercase()),
        None if Label::of(&name).is_some_and(|label| !label.is_short()) => (name, "Y".to_owned()),
        None => (part.to_owned(), name.to_uppercase()),
    }
}

/// The samples of a channel; integers, of which `most` is the largest of the part, are codes of as many bits as that takes.
fn samples(samples: FlatSamples, most: u32) -> (Samples, &'static str) {
    let code = |value: u32| match most {
        0 | 1 => value * 65_535,
        2..=255 => value * 257,
        256..=65_535 => value,
        _ => ((u64::from(value) + 0x8000) / 0x1_0001) as u32,
    };
    match samples {
        FlatSamples::F16(values) => (Samples::floats(values.into_iter().map(f32::from).collect()), "half"),
        FlatSamples::F32(values) => (Samples::floats(values), "float"),
        FlatSamples::U32(values) => {
            (Samples::words(values.into_iter().map(|value| code(value) as u16).collect()), "uint")
        }
    }
}

/// RGB, XYZ or XY in their order whatever the file's, or a single channel of any name; with the names of those that are left. Of a layer
/// with both, XYZ are the normals, and RGB is a preview of them. `None` without any channel.
fn raster(
    [width, height]: [usize; 2],
    depth: &'static str,
    mut channels: NamedSamples,
    is_normal: bool,
) -> Option<(Raster, Vec<String>)> {
    const RGB: [[&str; 2]; 3] = [["R", "RED"], ["G", "GREEN"], ["B", "BLUE"]];
    const XYZ: [[&str; 2]; 3] = [["X", "U"], ["Y", "V"], ["Z", "W"]];
    let place = |channels: &NamedSamples, names: &[&str]| {
        channels.iter().position(|(name, _)| names.contains(&name.as_str()))
    };
    let alpha = place(&channels, &["A", "ALPHA"]).map(|at| channels.remove(at).1);
    // The last of those with the most channels.
    let sets = if is_normal { [RGB, XYZ] } else { [XYZ, RGB] };
    let set =
        sets.iter().max_by_key(|set| set.iter().filter(|names| place(&channels, *names).is_some()).count());
    let mut take = |names: &[&str; 2]| place(&channels, names).map(|at| channels.remove(at).1);
    let mut taken: Vec<Samples> = set.into_iter().flatten().filter_map(&mut take).collect();
    if taken.is_empty() {
        taken = if channels.is_empty() {
            alpha.clone().into_iter().collect()
        } else {
            vec![channels.remove(0).1]
        };
    }
    let alpha = alpha.filter(|alpha| !alpha.is_all(1.0));
    let left = channels.into_iter().map(|(name, _)| name).collect();
    (!taken.is_empty())
        .then_some((Raster { width, height, depth, channels: taken, alpha, to_rec709: None }, left))
}

/// The picture in its display window where the two differ; 0 where the file has no data, normals up.
fn windowed(
    raster: Raster,
    data: IntegerBounds,
    display: IntegerBounds,
    name: &str,
    notes: &mut Vec<Note>,
) -> Raster {
    if data == display || raster.channels.iter().any(|c| !c.is_float()) {
        return raster;
    }
    let layer = name.to_owned();
    let inside = display.size.0 <= MAX_SIDE && display.size.1 <= MAX_SIDE;
    if data.size == display.size || !inside {
        notes.push(Note::DataWindow { layer });
        return raster;
    }
    let (width, height) = (display.size.0, display.size.1);
    notes.push(Note::PartialData { layer, data: [data.size.0, data.size.1], display: [width, height] });
    let place = |plane: &Samples| {
        let value = |index: usize| {
            let column = (index % width) as i64 + i64::from(display.position.0) - i64::from(data.position.0);
            let row = (index / width) as i64 + i64::from(display.position.1) - i64::from(data.position.1);
            let within =
                (0..raster.width as i64).contains(&column) && (0..raster.height as i64).contains(&row);
            if within { plane.at(row as usize * raster.width + column as usize) as f32 } else { 0.0 }
        };
        Samples::floats((0..width * height).map(value).collect())
    };
    let channels = raster.channels.iter().map(place).collect();
    Raster { width, height, channels, alpha: None, ..raster }
}

/// How many 8-byte numbers a block begins with: the version, then sizes and counts.
const NUMBERS: usize = 11;

/// Checks that no block of DWA claims to unpack into more than `most` bytes, which exr 1.74.2 allocates unchecked; leaves `reader` at its beginning.
///
/// # Errors
/// Those of the library, and where a block claims more.
fn check_dwa(reader: &mut ByteReader<'_>, meta: &MetaData, most: u64) -> exr::error::Result<()> {
    let is_dwa = |compression| matches!(compression, Compression::DWAA(_) | Compression::DWAB(_));
    if meta.headers.iter().any(|header| is_dwa(header.compression)) {
        for chunk in exr::block::read(&mut *reader, false)?.filter_chunks(false, |_, _, _| true)? {
            let chunk = chunk?;
            let header = meta.headers.get(chunk.layer_index);
            if let Some(header) = header.filter(|header| is_dwa(header.compression)) {
                check_block(header, &chunk.compressed_block, most)?;
            }
        }
        reader.rewind()?;
    }
    Ok(())
}

fn check_block(header: &Header, block: &CompressedBlock, most: u64) -> exr::error::Result<()> {
    let bytes = match block {
        CompressedBlock::ScanLine(block) => &block.compressed_pixels_le,
        CompressedBlock::Tile(block) => &block.compressed_pixels_le,
        _ => return Ok(()),
    };
    // The library takes a block of just this many bytes for the pixels themselves, and every other one for a packed one.
    let place = header.get_absolute_block_pixel_coordinates(header.get_block_data_indices(block)?)?;
    if bytes.len() == place.size.area() * header.channels.bytes_per_pixel {
        return Ok(());
    }
    let numbers = bytes.as_chunks::<8>().0.iter().take(NUMBERS).skip(1);
    match numbers.map(|eight| u64::from_le_bytes(*eight)).max() {
        Some(largest) if largest > most => {
            Err(exr::error::Error::Invalid(format!("a DWA block that claims {largest} bytes").into()))
        }
        _ => Ok(()),
    }
}
