//! Formats of materials, a file or folder each: which files and pictures hold the maps, by names, listings and documents, and the maps
//! as they are stored.

mod binding;
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

pub use binding::Binding;
pub(super) use candidate::Located;
pub(super) use picture::WholePicture;
pub use sidecar::Sidecar;

use candidate::Candidate;
use gltf::Gltf;
use mtl::Mtl;
use mtlx::Mtlx;

/// Locates the material at `path` with the options and bindings `used`.
///
/// # Errors
/// [`Error::Unreadable`], [`Error::BadImage`] where a document is broken, [`Error::NotAMaterial`] where maps are missing
/// or claimed twice by their names, [`Error::NoSuchExemplar`], [`Error::BadSidecar`].
pub(super) fn locate(path: &Path, used: &Sidecar) -> Result<Located, Error> {
    used.check_maps(path)?;
    let roles: Vec<_> = used.bindings.iter().map(Binding::role).collect();
    let mut found = candidates(&sidecar::material_of(path)?, &roles, &used.options.with_preset())?;
    found.bound.clone_from(&used.bindings);
    Ok(found)
}

/// The names that the material at `path` may have, the most likely first: which of them, its pixels decide.
pub(super) fn names(path: &Path, options: &ReadOptions) -> Result<Vec<String>, Error> {
    let found = candidates(&sidecar::material_of(path)?, &[], &options.with_preset())?;
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
        Ok(set) if !set.files.files.is_empty() => Ok(Located::new([first, Candidate::Set(set)])),
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::disk::open::NamedBy;

    #[test]
    fn a_located_file_knows_who_named_it() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path();
        for name in ["a_diffuse.png", "a_roughness.png", "n.png", "m.png"] {
            std::fs::write(path.join(name), "").unwrap();
        }
        std::fs::write(path.join("svbrdf.json"), r#"{"maps": {"normal": "n.png"}}"#).unwrap();
        let caller: Binding = "metallic=m.png".parse().unwrap();
        let used = Sidecar::load(path).unwrap().overridden_by(&ReadOptions::AUTO, &[caller]);
        let found = locate(path, &used).unwrap();
        let by: Vec<_> = found.bound.iter().map(|bound| bound.file().unwrap().named_by().clone()).collect();
        assert_eq!(by, [NamedBy::File(path.join("svbrdf.json")), NamedBy::User]);
        let Candidate::Set(set) = &found.candidates[0] else { panic!("{found:?}") };
        assert_eq!(set.file("a_diffuse.png").named_by(), &NamedBy::File(path.to_owned()));
    }
}
