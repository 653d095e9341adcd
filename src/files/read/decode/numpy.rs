//! npy arrays and npz archives of them.

use std::io::{self, ErrorKind, Read, Seek as _};

use exr::prelude::f16;

use super::layout::{self, ArrayAxes};
use super::place::{ByteReader, Decoded, DecodedFile, Layer, MAX_BYTES, alone, ratio};
use crate::error::Error;
use crate::npy::Header;
use crate::read::names::Label;
use crate::read::raster::{Buffer, Samples};
use crate::read::record::{Note, Subject, Unused};

/// Most arrays that are read of an archive.
const MOST_ARRAYS: usize = 64;

pub(crate) fn decode_archive(reader: ByteReader<'_>, place: DecodedFile<'_>) -> Result<Decoded, Error> {
    let invalid = |e: zip::result::ZipError| place.invalid("npz", e);
    let mut archive = zip::ZipArchive::new(reader).map_err(invalid)?;
    let names: Vec<String> = {
        let all: Vec<_> = archive.file_names().collect::<Result<_, _>>().map_err(invalid)?;
        all.into_iter().filter(|n| n.ends_with(".npy")).map(|n| n.into_owned()).collect()
    };
    if names.is_empty() {
        let found = archive.file_names().flatten().take(3).collect::<Vec<_>>().join(", ");
        let problem =
            format!("expected a picture or an npz of arrays, found a zip archive of other files: {found}");
        return Err(place.bad(problem, "unpack it, and open the folder"));
    }
    if names.len() > MOST_ARRAYS {
        let problem = format!("expected at most {MOST_ARRAYS} arrays in the npz, found {}", names.len());
        return Err(place.bad(problem, "save the maps as named arrays"));
    }
    // An archive bomb declares its size in its directory, or meets the limit of a single array or of all of them.
    let mut unpacked = 0_u64;
    for file in &names {
        unpacked = unpacked.saturating_add(archive.by_name(file).map_err(invalid)?.size());
    }
    if unpacked > MAX_BYTES {
        let problem =
            format!("expected at most {} GiB in the npz, found {} GiB", MAX_BYTES >> 30, unpacked >> 30);
        return Err(place.bad(problem, "save fewer or smaller arrays"));
    }
    let _reserved = place.reserve(unpacked)?;
    let mut shapes = Vec::new();
    for file in &names {
        let header = Header::read(archive.by_name(file).map_err(invalid)?);
        let header = header.map_err(|e| broken(&e, stem(file), place))?;
        // Texts and objects beside the maps.
        shapes.push(if header.kind.starts_with(['U', 'S', 'O']) { Vec::new() } else { header.shape });
    }
    let chosen: Vec<_> = layout::chosen(&shapes).collect();
    let has_pictures = chosen.iter().any(Option::is_some);
    let batch = layout::batch(&shapes).map(|count| count as usize);
    let mut decoded = Decoded { batch, ..Decoded::default() };
    let mut bytes = 0;
    for (file, (shape, axes)) in names.iter().zip(shapes.iter().zip(chosen)) {
        let name = stem(file);
        if axes.is_none() && has_pictures {
            decoded.notes.push(Note::Unused { what: format!("Array {name}"), why: Unused::NoPicture });
            continue;
        }
        let array = archive.by_name(file).map_err(invalid)?;
        let layer = decode(array, name, axes, place)?;
        // In memory: 2 to 4 bytes a sample.
        bytes += 4 * (layer.raster.width * layer.raster.height * layer.raster.channels.len()) as u64;
        drop(place.check_size(layer.raster.size().map(|side| side as u64), bytes, ratio::NUMPY)?);
        decoded.notes.extend(layout::note(name, shape, axes));
        decoded.layers.push(layer);
    }
    Ok(decoded)
}

/// The number of materials of an archive of batches.
pub(crate) fn batch(reader: ByteReader<'_>) -> Option<usize> {
    let mut archive = zip::ZipArchive::new(reader).ok()?;
    let names: Vec<String> = archive.file_names().flatten().map(|name| name.into_owned()).collect();
    let arrays = names.iter().filter(|name| name.ends_with(".npy")).take(MOST_ARRAYS);
    let shapes: Vec<_> =
        arrays.filter_map(|name| Some(Header::read(archive.by_name(name).ok()?).ok()?.shape)).collect();
    layout::batch(&shapes).map(|count| count as usize)
}

fn stem(file: &str) -> &str {
    file.trim_end_matches(".npy")
}

pub(crate) fn decode_array(mut reader: ByteReader<'_>, place: DecodedFile<'_>) -> Result<Decoded, Error> {
    let shape = Header::read(&mut reader).map_err(|e| broken(&e, "", place))?.shape;
    reader.rewind().map_err(|source| Error::unreadable(place.path, source))?;
    let axes = layout::chosen(std::slice::from_ref(&shape)).next().flatten();
    let layer = decode(reader, "", axes, place)?;
    Ok(Decoded { notes: layout::note("", &shape, axes).into_iter().collect(), ..alone(layer) })
}

/// The words for the array `name` at the beginning of a message.
fn whose(name: &str) -> String {
    if name.is_empty() { String::new() } else { format!("array {name}: ") }
}

fn broken(error: &io::Error, name: &str, place: DecodedFile<'_>) -> Error {
    match error.kind() {
        ErrorKind::UnexpectedEof => place.truncated(),
        _ => place.invalid("npy", format!("{}{error}", whose(name))),
    }
}

/// The array `name`, its axes read as `axes`; `None` where its shape is that of no picture.
fn decode(
    mut reader: impl Read,
    name: &str,
    axes: Option<ArrayAxes>,
    place: DecodedFile<'_>,
) -> Result<Layer, Error> {
    let whose = whose(name);
    let header = Header::read(&mut reader).map_err(|e| broken(&e, name, place))?;
    let ArrayAxes { height, width, count, planar, .. } = axes.ok_or_else(|| {
        place.bad(
            format!("{whose}expected the shape (h, w) or (h, w, 1 to 4), found {:?}", header.shape),
            "save each map as an array of rows, columns and channels",
        )
    })?;
    let bytes = width.checked_mul(height).and_then(|n| n.checked_mul(8 * count));
    let bytes = bytes.unwrap_or(u64::MAX).min(MAX_BYTES + 1);
    let _reserved = place.check_size([width, height], bytes, ratio::NUMPY)?;
    let samples = values(reader, &header).map_err(|e| broken(&e, name, place))?;
    let (values, depth) = samples.ok_or_else(|| {
        place.bad(
            format!("{whose}expected floats, bool, or integers from 0 to 255 or to 65535"),
            "convert it with astype",
        )
    })?;
    let (width, height, count) = (width as usize, height as usize, count as usize);
    // In Fortran order the first axis is the fastest: rows and columns are exchanged, and channels are at the other end.
    let channels = if planar == header.is_fortran { Samples::interleaved } else { Samples::planar };
    let mut channels = channels(values, count);
    if header.is_fortran {
        let place = |index: usize| index % width * height + index / width;
        channels = channels.iter().map(|plane| plane.picked(width * height, place)).collect();
    }
    let named = Label::of(name).map_or(place.what, |label| Subject::Map(label.role));
    let raster = DecodedFile { what: named, ..place }.raster([width, height], depth, channels);
    Ok(Layer { name: name.to_owned(), raster, uncropped: None, meaning: None })
}

/// The values of an array and the name of their type; `None` of a type that is no sample of a picture.
fn values(reader: impl Read, header: &Header) -> io::Result<Option<(Buffer, &'static str)>> {
    Ok(Some(match header.kind.as_str() {
        "f2" => (header.values(reader, |bytes| f16::from_le_bytes(bytes).to_f32())?.into(), "half"),
        "f4" => (header.values(reader, f32::from_le_bytes)?.into(), "float"),
        "f8" => (header.values(reader, |bytes| f64::from_le_bytes(bytes) as f32)?.into(), "double"),
        "b1" => (header.values(reader, |[byte]| if byte == 0 { 0_u8 } else { 255 })?.into(), "8-bit"),
        "u1" => (header.values(reader, u8::from_le_bytes)?.into(), "8-bit"),
        "u2" => (header.values(reader, u16::from_le_bytes)?.into(), "16-bit"),
        "i1" => return Ok(codes(header.values(reader, |bytes| i64::from(i8::from_le_bytes(bytes)))?)),
        "i2" => return Ok(codes(header.values(reader, |bytes| i64::from(i16::from_le_bytes(bytes)))?)),
        "i4" => return Ok(codes(header.values(reader, |bytes| i64::from(i32::from_le_bytes(bytes)))?)),
        "u4" => return Ok(codes(header.values(reader, |bytes| i64::from(u32::from_le_bytes(bytes)))?)),
        "i8" | "u8" => return Ok(codes(header.values(reader, i64::from_le_bytes)?)),
        _ => return Ok(None),
    }))
}

/// Integers of a type that is wider than their codes: a mask of 0 and 1, or codes of 8 or of 16 bits; `None` of others.
fn codes(values: Vec<i64>) -> Option<(Buffer, &'static str)> {
    let (least, most) = values.iter().fold((0, 0), |(low, high), value| (low.min(*value), high.max(*value)));
    let bytes = |of: fn(i64) -> u8| Buffer::from(values.iter().map(|value| of(*value)).collect::<Vec<_>>());
    match most {
        _ if least < 0 => None,
        0 | 1 => Some((bytes(|value| 255 * value as u8), "8-bit")),
        2..=255 => Some((bytes(|value| value as u8), "8-bit")),
        256..=65_535 => Some((values.iter().map(|value| *value as u16).collect::<Vec<_>>().into(), "16-bit")),
        _ => None,
    }
}
