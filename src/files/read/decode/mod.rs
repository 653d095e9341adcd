//! From a file to the samples that it stores. What they mean is the matter of `encoding`.
//!
//! How a file begins decides what it is, not its name; TGA alone, which begins with nothing of its own, goes by the name.

mod dds;
mod dwa;
mod exr;
mod head;
mod known;
mod ktx2;
mod numpy;
pub(super) mod panics;
mod picture;
mod place;
mod tiff;

use std::fs::File;
use std::io::{BufRead, BufReader, Seek};
use std::path::Path;

use super::note::{Note, Subject};
use super::raster::Raster;
use crate::error::Error;
pub(super) use place::{Decoded, Layer};
use place::{Place, alone};

/// Decodes the file `path`, which is expected to be `what`.
///
/// # Errors
/// [`Error::Unreadable`] without such a file, [`Error::BadImage`] where it is no image, broken or too large.
pub(super) fn decode_file(path: &Path, what: Subject) -> Result<Decoded, Error> {
    let file = File::open(path).map_err(|source| Error::unreadable(path, source))?;
    decode(BufReader::new(file), path, what)
}

/// As [`decode_file`], from what `reader` gives; `path` is the name for messages.
pub(super) fn decode(mut reader: impl BufRead + Seek, path: &Path, what: Subject) -> Result<Decoded, Error> {
    let place = Place { path, what };
    let head = reader.fill_buf().map_err(|source| Error::unreadable(path, source))?;
    let begins = |magic: &[u8]| head.starts_with(magic);
    if begins(&[0x76, 0x2f, 0x31, 0x01]) {
        exr::decode(reader, place)
    } else if begins(b"\x93NUMPY") {
        numpy::decode_array(reader, String::new(), place).map(alone)
    } else if begins(b"PK\x03\x04") || begins(b"PK\x05\x06") {
        numpy::decode_archive(reader, place)
    } else if begins(b"II*\0") || begins(b"MM\0*") || begins(b"II+\0") || begins(b"MM\0+") {
        tiff::decode(reader, place).map(alone)
    } else if begins(b"DDS ") {
        dds::decode(reader, place).map(alone)
    } else if begins(ktx2::MAGIC) {
        ktx2::decode(reader, place).map(alone)
    } else {
        picture::decode(reader, place)
    }
}

/// The only picture of a file.
///
/// # Errors
/// As [`decode_file`]; [`Error::BadImage`] where there are several.
pub(super) fn decode_one(path: &Path, what: Subject) -> Result<(Raster, Vec<Note>), Error> {
    let Decoded { mut layers, notes, .. } = decode_file(path, what)?;
    match layers.pop() {
        Some(only) if layers.is_empty() => Ok((only.raster, notes)),
        _ => {
            Err(Place { path, what }
                .bad("expected one picture, found several layers", "open the file itself"))
        }
    }
}

/// The picture of a photograph, of one or three channels: the only one of a file, or its layer without a name.
///
/// # Errors
/// As [`decode_file`]; [`Error::BadImage`] where no layer or several could be meant.
pub(super) fn decode_photograph(path: &Path) -> Result<(Raster, Vec<Note>), Error> {
    let place = Place { path, what: Subject::Photograph };
    let Decoded { mut layers, notes, .. } = decode_file(path, place.what)?;
    let unnamed = layers.iter().position(|layer| layer.name.is_empty());
    let chosen = if layers.len() == 1 { Some(0) } else { unnamed };
    let Some(chosen) = chosen else {
        let names: Vec<_> = layers.iter().map(|layer| layer.name.as_str()).collect();
        let problem = format!("expected one picture, found the layers {}", names.join(", "));
        return Err(place.bad(problem, "save the layer of the photograph alone"));
    };
    let raster = layers.swap_remove(chosen).raster;
    match raster.channels.len() {
        1 | 3 => Ok((raster, notes)),
        count => Err(place.bad(format!("expected gray or RGB, found {count} channels"), "convert it to RGB")),
    }
}
