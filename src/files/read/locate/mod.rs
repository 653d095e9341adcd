//! Locating: which files and pictures may hold the maps of a material, by names, folder listings and documents alone.

mod directory;
mod folder;
mod gltf;
mod grouping;
mod mtl;
mod mtlx;
pub(super) mod neighbours;
pub(super) mod sidecar;

use std::path::{Path, PathBuf};

use crate::error::Error;
use crate::files::open::NamedFile;
use crate::files::read::located::binding::{Binding, LocatedBinding};
use crate::files::read::located::{Candidate, Located, WholePicture};
use crate::files::read::options::ReadOptions;
use crate::files::read::options::extensions::{self, LISTING};
use crate::files::read::options::role::Role;
use sidecar::Sidecar;

/// Locates the material at `path` with the options and bindings `used`, of which `saved` are those of its sidecar file.
///
/// # Errors
/// [`Error::Unreadable`], [`Error::BadImage`] where a document is broken, [`Error::NotAMaterial`] where maps are missing
/// or claimed twice by their names, [`Error::NoSuchExemplar`], [`Error::NoTextures`], [`Error::BadSidecar`].
pub(super) fn locate(path: &Path, saved: &Sidecar, used: &Sidecar) -> Result<Located, Error> {
    let (of_sidecar, of_caller): (Vec<_>, Vec<_>) =
        used.bindings.iter().cloned().partition(|binding| saved.bindings.contains(binding));
    Sidecar { bindings: of_sidecar, ..Sidecar::default() }.check_maps(path)?;
    let bound = |binding: &Binding| {
        let file = if of_caller.contains(binding) {
            NamedFile::by_user(binding.file())
        } else {
            NamedFile::by_file(binding.file(), &Sidecar::path_for(path))
        };
        LocatedBinding { role: binding.role(), file, part: binding.part().map(str::to_owned) }
    };
    let bound: Vec<_> = used.bindings.iter().map(bound).collect();
    let roles: Vec<_> = bound.iter().map(|binding| binding.role).collect();
    let found = candidates(&sidecar::material_of(path)?, &roles, &used.options.with_preset())?;
    Ok(Located { bound, ..found })
}

/// What may be at `path` beside the maps of the roles `bound`.
fn candidates(path: &Path, bound: &[Role], options: &ReadOptions) -> Result<Located, Error> {
    if path.is_dir() {
        return folder::locate(path, path, "", bound);
    }
    if !path.exists()
        && let Some(prefix) = path.file_name()
    {
        return folder::locate(path, &folder_of(path), &prefix.to_string_lossy(), bound);
    }
    let extension = extensions::of_name(path);
    let first = match extension.as_str() {
        "gltf" | "glb" => Candidate::Gltf(gltf::locate(path, options)?),
        "mtl" => Candidate::Mtl(mtl::locate(path, options)?),
        "mtlx" => Candidate::Mtlx(mtlx::locate(path, options)?),
        _ => Candidate::Picture(WholePicture { file: NamedFile::by_user(path), refusal: None }),
    };
    let may_be_one_map = options.order.is_none() && !LISTING.contains(&extension.as_str());
    let around = if may_be_one_map { folder::around(path, bound) } else { None };
    // A set that cannot be located leaves the refusal of the picture as the error.
    let around = around.and_then(Result::ok).map(Candidate::Set);
    Ok(Located::from([first].into_iter().chain(around)))
}

/// The folder of a file that may be named without one.
fn folder_of(path: &Path) -> PathBuf {
    path.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new(".")).to_owned()
}
