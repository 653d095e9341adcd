//! npy arrays and npz archives of them, through the `npyz` library.

use std::io::{BufRead, ErrorKind, Read, Seek};

use exr::prelude::f16;
use npyz::{NpyFile, Order};

use svbrdf_core::error::Error;

use super::layout::{self, Axes};
use super::place::{Decoded, Layer, MAX_BYTES, Place, alone};
use crate::read::raster::{Buffer, Raster, Samples};

/// Most arrays that are read of an archive.
const MOST_ARRAYS: usize = 64;

/// Every array of an archive, by its name.
pub(crate) fn decode_archive(reader: impl BufRead + Seek, place: Place<'_>) -> Result<Decoded, Error> {
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
        let header = NpyFile::new(archive.by_name(file).map_err(invalid)?);
        shapes.push(header.map_err(|e| broken(&e, stem(file), place))?.shape().to_vec());
    }
    let chosen = layout::chosen(&shapes);
    let mut decoded = Decoded::default();
    let mut bytes = 0;
    for (file, (shape, axes)) in names.iter().zip(shapes.iter().zip(chosen)) {
        let name = stem(file);
        let array = archive.by_name(file).map_err(invalid)?;
        let layer = decode(array, name, axes, place)?;
        // In memory: 2 to 4 bytes a sample.
        bytes += 4 * (layer.raster.width * layer.raster.height * layer.raster.channels.len()) as u64;
        drop(place.check_size(layer.raster.width as u64, layer.raster.height as u64, bytes)?);
        decoded.notes.extend(layout::note(name, shape, axes));
        decoded.layers.push(layer);
    }
    Ok(decoded)
}

/// The name of an array by the file in its archive.
fn stem(file: &str) -> &str {
    file.trim_end_matches(".npy")
}

/// A file of one array.
pub(crate) fn decode_array(mut reader: impl BufRead + Seek, place: Place<'_>) -> Result<Decoded, Error> {
    let header = NpyFile::new(&mut reader).map_err(|e| broken(&e, "", place))?;
    let shape = header.shape().to_vec();
    drop(header);
    reader.rewind().map_err(|source| Error::unreadable(place.path, source))?;
    let axes = layout::chosen(std::slice::from_ref(&shape)).next().flatten();
    let layer = decode(reader, "", axes, place)?;
    Ok(Decoded { notes: layout::note("", &shape, axes).into_iter().collect(), ..alone(layer) })
}

/// The words for the array `name` at the beginning of a message.
fn whose(name: &str) -> String {
    if name.is_empty() { String::new() } else { format!("array {name}: ") }
}

fn broken(error: &std::io::Error, name: &str, place: Place<'_>) -> Error {
    match error.kind() {
        ErrorKind::UnexpectedEof => place.truncated(),
        _ => place.invalid("npy", format!("{}{error}", whose(name))),
    }
}

/// The array `name`, its axes read as `axes`; `None` where its shape is that of no picture.
fn decode(reader: impl Read, name: &str, axes: Option<Axes>, place: Place<'_>) -> Result<Layer, Error> {
    let whose = whose(name);
    let invalid = |e: std::io::Error| broken(&e, name, place);
    let file = NpyFile::new(reader).map_err(invalid)?;
    let Axes { height, width, count, planar, .. } = axes.ok_or_else(|| {
        place.bad(
            format!("{whose}expected the shape (h, w) or (h, w, 1 to 4), found {:?}", file.shape()),
            "save each map as an array of rows, columns and channels",
        )
    })?;
    let bytes = width.checked_mul(height).and_then(|n| n.checked_mul(8 * count));
    let _reserved = place.check_size(width, height, bytes.unwrap_or(u64::MAX).min(MAX_BYTES + 1))?;
    if file.order() == Order::Fortran {
        return Err(
            place.bad(format!("{whose}expected rows first, found Fortran order"), "save a C-ordered copy")
        );
    }
    let (values, depth) = values(file, invalid, || {
        place.bad(
            format!("{whose}expected float16, float32, float64, uint8 or uint16"),
            "convert it with astype",
        )
    })?;
    let (width, height, count) = (width as usize, height as usize, count as usize);
    let channels = if planar { Samples::planar } else { Samples::interleaved };
    let channels = channels(values, count);
    Ok(Layer { name: name.to_owned(), raster: Raster::with_alpha(width, height, depth, channels) })
}

fn values<R: Read>(
    file: NpyFile<R>,
    invalid: impl Fn(std::io::Error) -> Error,
    other: impl Fn() -> Error,
) -> Result<(Buffer, &'static str), Error> {
    let count = file.len() as usize;
    // Grows with what is really there, not with what the header claims.
    fn take<T, E>(values: impl Iterator<Item = Result<T, E>>) -> Result<Vec<T>, E> {
        values.collect()
    }
    let floats = |values: &mut dyn Iterator<Item = std::io::Result<f32>>| -> Result<Buffer, Error> {
        Ok(take(values).map_err(&invalid)?.into())
    };
    let (samples, depth) = match file.try_data::<f32>() {
        Ok(data) => (take(data).map_err(&invalid)?.into(), "float"),
        Err(file) => match file.try_data::<f16>() {
            Ok(data) => (floats(&mut data.map(|x| x.map(f32::from)))?, "half"),
            Err(file) => match file.try_data::<f64>() {
                Ok(data) => (floats(&mut data.map(|x| x.map(|x| x as f32)))?, "double"),
                Err(file) => match file.try_data::<u8>() {
                    Ok(data) => (take(data).map_err(&invalid)?.into(), "8-bit"),
                    Err(file) => {
                        let data = file.try_data::<u16>().map_err(|_| other())?;
                        (take(data).map_err(&invalid)?.into(), "16-bit")
                    }
                },
            },
        },
    };
    if samples.len() != count {
        return Err(invalid(ErrorKind::UnexpectedEof.into()));
    }
    Ok((samples, depth))
}
