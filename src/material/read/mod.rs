//! Reading a material from files.
//!
//! `packed`, `folder`, `layers`, `gltf` and `mtlx` find the maps, `decode` turns a file into the samples that it stores,
//! `encoding` and `normals` turn samples into linear values. What opens is listed in `docs/formats.md`.
//!
//! Colour chunks are ignored. What the values mean is said by [`ReadOptions`]; what these leave open is found out from
//! names and pixels, and recorded as an [`Assumption`].

mod assumption;
mod decode;
mod encoding;
mod evidence;
mod folder;
mod found;
mod gltf;
mod layers;
mod mtlx;
mod names;
mod normals;
mod options;
mod packed;
mod raster;
mod report;
pub(crate) mod resize;

use std::io::Cursor;
use std::path::{Path, PathBuf};

pub use assumption::{Assumption, Certainty, What};
pub use options::{Albedo, NonFinite, NormalY, Order, ReadOptions, Roughness};
pub use report::MapReport;

use crate::error::Error;
use crate::material::Material;
use crate::progress::Progress;
use crate::real::Real;
use decode::Decoded;
use found::Found;

/// A material, and how it came to be.
#[derive(Clone, Debug, PartialEq)]
pub struct Read<T> {
    pub material: Material<T>,
    /// What was taken for granted, each with its reason.
    pub assumptions: Vec<Assumption>,
    /// What else was found, one sentence each, for the user.
    pub notes: Vec<String>,
    /// The files that were read, each once, for watching. None for a material from memory.
    pub files: Vec<PathBuf>,
    /// What each map looks like as stored.
    pub maps: Vec<MapReport>,
}

impl<T> Read<T> {
    /// Notes and assumptions, a line each.
    pub fn said(&self) -> impl Iterator<Item = String> {
        self.notes.iter().cloned().chain(self.assumptions.iter().map(ToString::to_string))
    }

    /// The assumptions that could as well be otherwise.
    pub fn unsure(&self) -> impl Iterator<Item = &Assumption> {
        self.assumptions.iter().filter(|a| a.certainty == Certainty::Unsure)
    }
}

/// Reads the material that `path` names: a packed or layered image, a folder, the common prefix of files, or one of them.
///
/// Each file is one step of `progress`.
///
/// # Errors
/// [`Error::Unreadable`] where there is no such file or folder, [`Error::BadImage`] where a file is no image, is
/// broken or too large, [`Error::NotAMaterial`] where a map is missing, claimed twice or gray though it is the
/// normal map, [`Error::SizesDiffer`] where maps differ in shape, [`Error::OutOfRange`] at NaN and infinity,
/// [`Error::Cancelled`].
pub fn read<T: Real>(path: &Path, options: &ReadOptions, progress: &Progress) -> Result<Read<T>, Error> {
    finish(find(path, options, progress)?, options)
}

/// Reads a packed or layered image that lies in memory; `name` is the name of the material.
///
/// # Errors
/// As [`read`].
pub fn read_bytes<T: Real>(name: &str, bytes: &[u8], options: &ReadOptions) -> Result<Read<T>, Error> {
    let path = Path::new(name);
    let decoded = decode::decode(Cursor::new(bytes), path, "material")?;
    let found = within(path, decoded, options)?;
    let read = finish(Found { name: name.to_owned(), ..found }, options)?;
    Ok(Read { files: Vec::new(), ..read })
}

fn find(path: &Path, options: &ReadOptions, progress: &Progress) -> Result<Found, Error> {
    if path.is_dir() {
        return folder::open(path, path, "", progress);
    }
    if !path.exists()
        && let Some(prefix) = path.file_name()
    {
        let folder = path.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."));
        return folder::open(path, folder, &prefix.to_string_lossy(), progress);
    }
    let extension = path.extension().unwrap_or_default().to_string_lossy().to_lowercase();
    match extension.as_str() {
        "gltf" | "glb" => return gltf::open(path, options, progress),
        "mtlx" => return mtlx::open(path, options, progress),
        _ => (),
    }
    progress.begin(1);
    let decoded = decode::decode_file(path, "material")?;
    progress.step()?;
    let found = within(path, decoded, options);
    match found {
        Err(Error::NotAMaterial { .. }) if options.order.is_none() => {
            folder::open_around(path, progress).and_then(Result::ok).map_or(found, Ok)
        }
        found => found,
    }
}

/// The material within one file: a packed picture, or one of named layers.
fn within(path: &Path, decoded: Decoded, options: &ReadOptions) -> Result<Found, Error> {
    let Decoded { mut layers, mut notes, native } = decoded;
    let mut found = match layers.pop() {
        Some(only) if layers.is_empty() && !layers::is_named(&only) => {
            packed::unpack(path, &only.raster, options)?
        }
        last => layers::assemble(path, layers.into_iter().chain(last).collect(), native)?,
    };
    notes.append(&mut found.notes);
    Ok(Found { notes, ..found })
}

fn finish<T: Real>(mut found: Found, options: &ReadOptions) -> Result<Read<T>, Error> {
    let maps = report::maps(&found);
    let transparent = |(name, source): (&str, &found::Source)| {
        let noted = source.raster.alpha.is_some() && name != "normal";
        noted.then(|| format!("The {name} map is partly transparent; its alpha is ignored."))
    };
    let noted: Vec<_> = encoding::sources(&found).into_iter().filter_map(transparent).collect();
    found.notes.extend(noted);
    let (planes, [width, height]) = encoding::planes(&mut found, options)?;
    let material = Material::new(found.name, width, height, planes)?;
    Ok(Read { material, assumptions: found.assumptions, notes: found.notes, files: found.files, maps })
}
