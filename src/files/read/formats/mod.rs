//! Formats of materials, a file or folder each: which files and pictures hold the maps, by names, listings and documents, and the maps
//! as they are stored.

mod candidate;
mod folder;
mod gltf;
mod mtl;
mod mtlx;
mod packed;
mod picture;
mod set;
mod sidecar;
mod tile;

use std::path::Path;

use crate::disk::atomic::folder_of;
use crate::disk::open::NamedFile;
use crate::error::Error;
use crate::read::names::{LISTING, Label, extension, list};
use crate::read::options::{ReadOptions, Role};

pub(super) use candidate::Located;
pub(super) use picture::WholePicture;
pub use sidecar::{Binding, Sidecar};

use candidate::Candidate;
use gltf::Gltf;
use mtl::Mtl;
use mtlx::Mtlx;

/// Locates the material at `path` with the maps of `bindings` in place of its own.
pub(super) fn locate(path: &Path, options: &ReadOptions, bindings: &[Binding]) -> Result<Located, Error> {
    let roles: Vec<_> = bindings.iter().map(Binding::role).collect();
    Ok(Located { bound: bindings.to_vec(), ..candidates(path, &roles, options)? })
}

/// The names that the material at `path` may have, the most likely first: which of them, its pixels decide.
pub(super) fn names(path: &Path, options: &ReadOptions) -> Result<Vec<String>, Error> {
    let found = candidates(path, &[], options)?;
    Ok(match found.name {
        Some(name) => vec![name],
        None => found.candidates.iter().map(Candidate::name).collect(),
    })
}

/// Whether `path` is no file and no folder, but the beginning of the names of files.
pub fn is_prefix(path: &Path) -> bool {
    let prefix = path.file_name().unwrap_or_default().to_string_lossy();
    let files = || list(path, folder_of(path), &prefix);
    !path.exists() && !prefix.is_empty() && files().is_ok_and(|files| !files.is_empty())
}

/// What may be at `path` beside the maps of the roles `bound`.
fn candidates(path: &Path, bound: &[Role], options: &ReadOptions) -> Result<Located, Error> {
    if path.is_dir() {
        return match folder::only_file(path)? {
            Some(only) => candidates(&only, bound, options),
            None => folder::locate(path, path, "", bound),
        };
    }
    if !path.exists()
        && let Some(prefix) = path.file_name()
    {
        return folder::locate(path, folder_of(path), &prefix.to_string_lossy(), bound);
    }
    let extension = extension(path);
    let first = match extension.as_str() {
        "gltf" | "glb" => Candidate::Gltf(Gltf::locate(path, options)?.into()),
        "mtl" => Candidate::Mtl(Mtl::locate(path, options)?),
        "mtlx" => Candidate::Mtlx(Mtlx::locate(path, options)?),
        _ => Candidate::Picture(WholePicture::by_user(path)),
    };
    let may_be_one_map = options.order.is_none() && !LISTING.contains(&extension.as_str());
    if !may_be_one_map {
        return Ok(Located::new([first]));
    }
    let of_map = Label::of(&path.file_stem().unwrap_or_default().to_string_lossy()).is_some();
    match folder::around(path, bound) {
        Ok(set) if !set.files.is_empty() => Ok(Located::new([first, Candidate::Set(set)])),
        // A set that cannot be located is the refusal of a picture that is named after a map.
        Err(error @ Error::NotAMaterial { .. }) if of_map => {
            Ok(Located::new([Candidate::Picture(WholePicture {
                file: NamedFile::by_user(path),
                refusal: Some(error),
            })]))
        }
        _ => Ok(Located::new([first])),
    }
}
