//! Reading a material from files.
//!
//! Three steps, one file each: `layout` finds the four maps, `decode` turns an image file into the codes that it
//! stores, `encoding` turns codes into linear values. What opens:
//!
//! - a packed PNG strip of square tiles: any photos, then normal | diffuse | roughness | specular;
//! - a folder with one PNG file a map, or the common prefix of such files, as in `results/gt` for
//!   `results/gt_normals.png`, `results/gt_diffuse.png` and so on.
//!
//! Colour chunks are ignored: what the values mean is said by [`ReadOptions`].

mod decode;
mod encoding;
mod layout;
mod names;
mod options;

use std::io::Cursor;
use std::path::{Path, PathBuf};

pub use options::{Albedo, NormalY, ReadOptions};

use crate::error::Error;
use crate::material::Material;
use crate::progress::Progress;
use crate::real::Real;
use layout::Found;

/// A material, and how it came to be.
#[derive(Clone, Debug, PartialEq)]
pub struct Read<T> {
    pub material: Material<T>,
    /// What was assumed or found, one sentence each, for the user.
    pub notes: Vec<String>,
    /// The files that were read, each once, for watching. None for a material from memory.
    pub files: Vec<PathBuf>,
}

/// Reads the material that `path` names: a packed strip, a folder, or the common prefix of four files.
///
/// Each file is one step of `progress`.
///
/// # Errors
/// [`Error::Unreadable`] where there is no such file or folder, [`Error::BadImage`] where a file is no image, is
/// broken or too large, [`Error::NotAMaterial`] where a map is missing, claimed twice or gray though it is the
/// normal map, [`Error::SizesDiffer`] where maps differ in size, [`Error::Cancelled`].
pub fn read<T: Real>(path: &Path, options: &ReadOptions, progress: &Progress) -> Result<Read<T>, Error> {
    let found = layout::find(path, progress)?;
    let mut files = found.files.to_vec();
    files.dedup();
    Ok(Read { files, ..finish(found, options)? })
}

/// Reads a packed strip that lies in memory; `name` is the name of the material.
///
/// # Errors
/// As [`read`].
pub fn read_bytes<T: Real>(name: &str, bytes: &[u8], options: &ReadOptions) -> Result<Read<T>, Error> {
    let path = Path::new(name);
    let strip = decode::decode(Cursor::new(bytes), path, "packed strip")?;
    let found = layout::unpack(path, strip)?;
    finish(Found { name: name.to_owned(), ..found }, options)
}

fn finish<T: Real>(mut found: Found, options: &ReadOptions) -> Result<Read<T>, Error> {
    let planes = encoding::planes(&mut found, options)?;
    let (width, height) = (found.maps[0].width, found.maps[0].height);
    let material = Material::new(found.name, width, height, planes)?;
    Ok(Read { material, notes: found.notes, files: Vec::new() })
}
