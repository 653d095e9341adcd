//! Decoding: from a file to the samples that it stores.
//!
//! The first bytes of a file decide its format, not its name; TGA alone, which begins with nothing of its own, goes by the
//! name.

mod dds;
pub(crate) mod exr;
mod jpeg;
mod known;
mod layout;
mod numpy;
mod pfm;
mod picture;
mod place;
mod tiff;
mod tiff_jpeg;

use std::io::{BufRead as _, Seek as _, SeekFrom};
use std::path::Path;

use crate::disk::open::NamedFile;
use crate::disk::refuse_pointer;
use crate::error::Error;
use crate::read::names::Label;
use crate::read::raster::Raster;
use crate::read::record::{Note, Subject, Unused};
pub(super) use place::{ByteReader, Decoded, Layer, reader};

use place::{DecodedFile, alone};

/// Decodes `file`, which is expected to be `what`.
///
/// # Errors
/// [`Error::Unreadable`] without such a file, [`Error::BadImage`] where it is no image, broken or too large.
pub(super) fn whole(file: &NamedFile, what: Subject) -> Result<Decoded, Error> {
    let mut decoded = from_reader(reader(file.open()?), file.path(), what)?;
    let by = file.outside().map(Path::to_owned);
    decoded.notes.extend(by.map(|by| Note::OutsideFolder { file: file.path().to_owned(), by }));
    Ok(decoded)
}

/// The number of materials of an npz file of batches; `None` of others.
pub(super) fn batch(file: &NamedFile) -> Option<usize> {
    numpy::batch(reader(file.open().ok()?))
}

/// As [`whole`], from what `reader` gives; `path` is the name for messages.
pub(super) fn from_reader(mut reader: ByteReader<'_>, path: &Path, what: Subject) -> Result<Decoded, Error> {
    let unreadable = |source| Error::unreadable(path, source);
    let length = reader.seek(SeekFrom::End(0)).map_err(unreadable)?;
    reader.rewind().map_err(unreadable)?;
    let place = DecodedFile { length, ..DecodedFile::of(path, what) };
    let head = reader.fill_buf().map_err(unreadable)?;
    refuse_pointer(path, head)?;
    let begins = |magic: &[u8]| head.starts_with(magic);
    if begins(&[0x76, 0x2f, 0x31, 0x01]) {
        exr::decode(reader, place)
    } else if begins(b"\x93NUMPY") {
        numpy::decode_array(reader, place)
    } else if begins(b"PK\x03\x04") || begins(b"PK\x05\x06") {
        numpy::decode_archive(reader, place)
    } else if begins(b"II*\0") || begins(b"MM\0*") || begins(b"II+\0") || begins(b"MM\0+") {
        tiff::decode(reader, place)
    } else if begins(b"PF\n") || begins(b"Pf\n") {
        pfm::decode(reader, place).map(alone)
    } else if begins(b"DDS ") {
        dds::decode(reader, place)
    } else {
        picture::decode(reader, place)
    }
}

/// The picture of a file: the only one, or of several layers the one without a name, or else the one that is named after its map.
///
/// # Errors
/// As [`whole`]; [`Error::BadImage`] where several could be meant.
pub(super) fn one(file: &NamedFile, what: Subject) -> Result<(Layer, Vec<Note>), Error> {
    let Decoded { mut layers, mut notes, .. } = whole(file, what)?;
    let is_named = |layer: &Layer| matches!(what, Subject::Map(role) if Label::of(&layer.name).is_some_and(|label| label.role == role));
    let named: Vec<_> = (0..layers.len()).filter(|at| is_named(&layers[*at])).collect();
    let unnamed = layers.iter().position(|layer| layer.name.is_empty());
    let chosen = match (layers.len(), unnamed, named.as_slice()) {
        (1, ..) => 0,
        (_, Some(unnamed), _) => unnamed,
        (_, None, [only]) => *only,
        _ => {
            let names: Vec<_> = layers.iter().map(|layer| layer.name.as_str()).collect();
            let problem = format!("expected one picture, found the layers {}", names.join(", "));
            let remedy = match what {
                Subject::Photograph => "save the layer of the photograph alone",
                _ => "open the file itself",
            };
            return Err(DecodedFile::of(file.path(), what).bad(problem, remedy));
        }
    };
    let chosen = layers.swap_remove(chosen);
    let unused = |layer: Layer| Note::Unused { what: format!("Layer {}", layer.name), why: Unused::NotAMap };
    notes.extend(layers.into_iter().map(unused));
    Ok((chosen, notes))
}

/// The picture of a photograph, of one or three channels.
///
/// # Errors
/// As [`one`]; [`Error::BadImage`] where it has other channels.
pub(super) fn photograph(file: &NamedFile) -> Result<(Raster, Vec<Note>), Error> {
    let (Layer { raster, .. }, notes) = one(file, Subject::Photograph)?;
    match raster.channels.len() {
        1 | 3 => Ok((raster, notes)),
        count => {
            let place = DecodedFile::of(file.path(), Subject::Photograph);
            Err(place.bad(format!("expected gray or RGB, found {count} channels"), "convert it to RGB"))
        }
    }
}
