//! From a file to the samples that it stores. What they mean is the matter of `encoding`.
//!
//! What a file is, is told by how it begins, not by its name.

mod dwa;
mod exr;
mod head;
mod numpy;
pub mod panic_guard;
mod picture;
mod tiff;

use std::fs::File;
use std::io::{BufRead, BufReader, Seek};
use std::path::Path;

use super::note::{Note, Subject};
use super::raster::Raster;
use super::role::Role;
use crate::error::Error;

/// Largest side of a map: the largest that material libraries publish.
const MAX_SIDE: usize = 16_384;
/// Largest width of an image: a strip of four of the largest maps. The same upright.
const MAX_WIDTH: usize = 4 * MAX_SIDE;
/// Most bytes that an image may decode to: a strip of the largest size takes 3 GiB in 8-bit RGB.
const MAX_BYTES: u64 = 4 << 30;

/// The formats that open, for messages.
const FORMATS: &str = "PNG, TIFF, JPEG, HDR, EXR, npy or npz";

/// One picture of a file: of a layered file a layer, of an archive an array.
#[derive(Clone, Debug, PartialEq)]
pub struct Layer {
    /// Empty for the only picture of a file.
    pub name: String,
    pub raster: Raster,
}

/// What a file holds.
#[derive(Debug, Default)]
pub struct Decoded {
    pub layers: Vec<Layer>,
    /// Whether this program wrote the file: then it means what this program means.
    pub native: bool,
    /// What this program wrote into a packed picture: its order and encoding.
    pub meaning: Option<String>,
    /// What else was noticed.
    pub notes: Vec<Note>,
}

/// Who is decoding what: for messages.
#[derive(Clone, Copy, Debug)]
struct Place<'a> {
    path: &'a Path,
    what: Subject,
}

impl Place<'_> {
    fn bad(self, problem: impl AsRef<str>, remedy: &str) -> Error {
        Error::BadImage {
            path: self.path.to_owned(),
            problem: format!("{}: {}", self.what, problem.as_ref()),
            remedy: remedy.to_owned(),
        }
    }

    /// An error of a library that decodes `format`.
    fn invalid(self, format: &str, found: impl std::fmt::Display) -> Error {
        self.bad(format!("expected a valid {format}, found: {found}"), "write the file again")
    }

    /// Whether the picture is known to hold data, for which colour spaces mean nothing.
    fn is_data(self) -> bool {
        match self.what {
            Subject::Map(role) => {
                role.packing().is_some() || matches!(role, Role::Normal | Role::Roughness | Role::Metallic)
            }
            _ => false,
        }
    }

    fn truncated(self) -> Error {
        self.bad("expected the whole image, found the end of the file within it", "copy the file again")
    }

    /// Refuses sizes before anything is allocated: `bytes` is what all samples take.
    fn check_size(self, width: u64, height: u64, bytes: u64) -> Result<(), Error> {
        if width == 0 || height == 0 {
            return Err(
                self.bad(format!("expected at least one pixel, found {width} x {height}"), "write it again")
            );
        }
        let (long, short) = (width.max(height), width.min(height));
        if long > MAX_WIDTH as u64 || short > MAX_SIDE as u64 || bytes > MAX_BYTES {
            let problem = format!(
                "expected at most {MAX_WIDTH} x {MAX_SIDE} pixels and {} GiB, found {width} x {height}",
                MAX_BYTES >> 30
            );
            return Err(self.bad(problem, "scale it down"));
        }
        Ok(())
    }
}

/// Decodes the file `path`, which is expected to be `what`.
///
/// # Errors
/// [`Error::Unreadable`] without such a file, [`Error::BadImage`] where it is no image, broken or too large.
pub fn decode_file(path: &Path, what: Subject) -> Result<Decoded, Error> {
    let file = File::open(path).map_err(|source| Error::unreadable(path, source))?;
    decode(BufReader::new(file), path, what)
}

/// As [`decode_file`], from what `reader` gives; `path` is the name for messages.
pub fn decode(mut reader: impl BufRead + Seek, path: &Path, what: Subject) -> Result<Decoded, Error> {
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
    } else {
        picture::decode(reader, place)
    }
}

/// The only picture of a file.
///
/// # Errors
/// As [`decode_file`]; [`Error::BadImage`] where there are several.
pub fn decode_one(path: &Path, what: Subject) -> Result<(Raster, Vec<Note>), Error> {
    let Decoded { mut layers, notes, .. } = decode_file(path, what)?;
    match layers.pop() {
        Some(only) if layers.is_empty() => Ok((only.raster, notes)),
        _ => {
            Err(Place { path, what }
                .bad("expected one picture, found several layers", "open the file itself"))
        }
    }
}

fn alone(layer: impl Into<Layer>) -> Decoded {
    Decoded { layers: vec![layer.into()], ..Decoded::default() }
}

impl From<Raster> for Layer {
    fn from(raster: Raster) -> Self {
        Self { name: String::new(), raster }
    }
}

/// Takes pixels of `count` interleaved samples apart.
fn planes<S: Copy, U>(samples: &[S], count: usize, of: impl Fn(S) -> U) -> Vec<Vec<U>> {
    (0..count).map(|channel| samples.iter().skip(channel).step_by(count).map(|&s| of(s)).collect()).collect()
}
