//! EXR through the `exr` library: half, float and uint; any channels, layers and parts; the largest level.

use std::collections::BTreeMap;
use std::io::Seek as _;

use exr::image::FlatSamples;
use exr::meta::MetaData;
use exr::meta::attribute::{IntegerBounds, Text};
use exr::prelude::{AnyChannel, FlatImage, ReadChannels, ReadLayers, read};

use super::dwa;
use super::place::{Decoded, DecodedFile, Layer, MAX_SIDE};
use super::reader::Reader;
use crate::disk::panics::caught;
use crate::error::Error;
use crate::read::raster::{Raster, Samples};
use crate::read::record::Note;

/// The beginning of the comments of an EXR that this program wrote as a material.
pub(crate) const NATIVE: &str = "svbrdf:version=1\n";
/// Blocks of DWA may take so many bytes more than their samples: they are padded to 8 x 8.
const SMALL: u64 = 1 << 20;

/// The channels of one layer: name in capitals, samples.
type NamedSamples = Vec<(String, Samples)>;

pub(crate) fn decode(mut reader: Reader<'_>, place: DecodedFile<'_>) -> Result<Decoded, Error> {
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
    caught(|| dwa::check(&mut reader, &meta, bytes + SMALL))
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
        drop(place.check_size(width, height, bytes)?);
    }
    Ok(bytes)
}

fn layers(image: FlatImage, place: DecodedFile<'_>) -> Result<Decoded, Error> {
    let mut decoded = Decoded::default();
    let display = image.attributes.display_window;
    if image.attributes.chromaticities.is_some_and(|c| (c.red.0 - 0.64).abs() + (c.red.1 - 0.33).abs() > 0.01)
    {
        decoded.notes.push(Note::Primaries);
    }
    for part in image.layer_data {
        let size = [part.size.0, part.size.1];
        let data = IntegerBounds::new(part.attributes.layer_position, part.size);
        let comments = part.attributes.comments.map(|text| text.to_string()).unwrap_or_default();
        decoded.native |= comments.starts_with(NATIVE);
        let own = part.attributes.layer_name.map(|name| name.to_string()).unwrap_or_default();
        let mut named: BTreeMap<String, NamedSamples> = BTreeMap::new();
        let mut depth = "half";
        for AnyChannel { name, sample_data, .. } in part.channel_data.list {
            let (layer, channel) = split(&own, &name);
            let (samples, found) = samples(sample_data);
            depth = if found == "half" { depth } else { found };
            named.entry(layer).or_default().push((channel, samples));
        }
        for (name, channels) in named {
            let Some(raster) = raster(size, depth, channels) else { continue };
            let raster = windowed(raster, data, display, &name, &mut decoded.notes);
            decoded.layers.push(Layer { name, raster });
        }
    }
    if decoded.layers.is_empty() {
        return Err(
            place.bad("expected channels such as R, G, B or Y, found none of them", "rename its channels")
        );
    }
    Ok(decoded)
}

/// `diffuse.R` is channel R of layer `diffuse`; a part's name stands for a missing layer's.
fn split(part: &str, channel: &Text) -> (String, String) {
    let name = channel.to_string();
    match name.rsplit_once('.') {
        Some((layer, channel)) => (layer.to_owned(), channel.to_uppercase()),
        None => (part.to_owned(), name.to_uppercase()),
    }
}

fn samples(samples: FlatSamples) -> (Samples, &'static str) {
    match samples {
        FlatSamples::F16(values) => (Samples::floats(values.into_iter().map(f32::from).collect()), "half"),
        FlatSamples::F32(values) => (Samples::floats(values), "float"),
        FlatSamples::U32(values) => (Samples::floats(values.into_iter().map(|v| v as f32).collect()), "uint"),
    }
}

/// RGB, XYZ or XY in their order whatever the file's, or a single channel of any name; `None` without any.
fn raster([width, height]: [usize; 2], depth: &'static str, mut channels: NamedSamples) -> Option<Raster> {
    let mut take = |names: &[&str]| {
        let place = channels.iter().position(|(name, _)| names.contains(&name.as_str()))?;
        Some(channels.swap_remove(place).1)
    };
    let alpha = take(&["A", "ALPHA"]);
    let ordered: Vec<Samples> = [["R", "RED", "X", "U"], ["G", "GREEN", "Y", "V"], ["B", "BLUE", "Z", "W"]]
        .iter()
        .filter_map(|n| take(n))
        .collect();
    let channels = if ordered.is_empty() {
        channels.into_iter().next().map(|(_, samples)| samples).or(alpha.clone()).into_iter().collect()
    } else {
        ordered
    };
    let alpha = alpha.filter(|alpha| !alpha.is_all(1.0));
    (!channels.is_empty()).then_some(Raster { width, height, depth, channels, alpha })
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
