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

use std::path::Path;

use crate::disk::open::NamedFile;
use crate::error::Error;
use crate::read::names::{Label, folder_of, list};
use crate::read::options::extensions::{self, LISTING};
use crate::read::options::{ReadOptions, Role};

pub use binding::Binding;
pub(super) use candidate::Located;
pub(super) use picture::WholePicture;
pub use sidecar::Sidecar;

use candidate::Candidate;
use gltf::Gltf;
use mtl::Mtl;
use mtlx::Mtlx;

/// Locates the material at `path` with the options and bindings `used`, of which `saved` are those of its sidecar file.
///
/// # Errors
/// [`Error::Unreadable`], [`Error::BadImage`] where a document is broken, [`Error::NotAMaterial`] where maps are missing
/// or claimed twice by their names, [`Error::NoSuchExemplar`], [`Error::BadSidecar`].
pub(super) fn locate(path: &Path, saved: &Sidecar, used: &Sidecar) -> Result<Located, Error> {
    let (of_sidecar, of_caller): (Vec<_>, Vec<_>) =
        used.bindings.iter().cloned().partition(|binding| saved.bindings.contains(binding));
    Sidecar { bindings: of_sidecar, ..Sidecar::default() }.check_maps(path)?;
    let bound = |binding: &Binding| match of_caller.contains(binding) {
        true => binding.located(|file| NamedFile::by_user(file)),
        false => binding.located(|file| NamedFile::by_file(file, &Sidecar::path_for(path))),
    };
    let bound: Vec<_> = used.bindings.iter().map(bound).collect();
    let roles: Vec<_> = bound.iter().map(|binding| binding.role()).collect();
    let mut found = candidates(&sidecar::material_of(path)?, &roles, &used.options.with_preset())?;
    found.bound = bound;
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
    let files = || list(path, &folder_of(path), &prefix);
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
        return folder::locate(path, &folder_of(path), &prefix.to_string_lossy(), bound);
    }
    let extension = extensions::of_name(path);
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

    /// A folder of files without any content: no picture could be decoded.
    fn folder(files: &[&str]) -> tempfile::TempDir {
        let folder = tempfile::tempdir().unwrap();
        for file in files {
            let path = folder.path().join(file);
            std::fs::create_dir_all(path.parent().unwrap()).unwrap();
            std::fs::write(path, "").unwrap();
        }
        folder
    }

    fn located(path: &Path, bindings: &[&str]) -> Located {
        let bindings = bindings.iter().map(|text| text.parse().unwrap()).collect();
        let used = Sidecar { bindings, ..Sidecar::default() };
        locate(path, &Sidecar::default(), &used).unwrap()
    }

    /// The files of each candidate.
    fn files(located: &Located) -> Vec<Vec<String>> {
        let of = |candidate: &Candidate| match candidate {
            Candidate::Picture(picture) => {
                vec![picture.file.path().file_name().unwrap().to_string_lossy().into()]
            }
            Candidate::Set(set) => {
                let mut files: Vec<_> = set.files.files.iter().map(|file| file.file.clone()).collect();
                files.sort();
                files
            }
            other => panic!("{other:?}"),
        };
        located.candidates.iter().map(of).collect()
    }

    const MAPS: [&str; 3] = ["a_diffuse.png", "a_normal.png", "a_roughness.png"];

    #[test]
    fn maps_are_located_by_their_names_alone() {
        let folder = folder(&["a_normal.png", "a_diffuse.png", "a_roughness.png", "notes.txt", "photo.jpg"]);
        let found = located(folder.path(), &[]);
        assert_eq!(files(&found), [MAPS]);
        assert_eq!(files(&located(&folder.path().join("a"), &[])), [MAPS]);
        let Candidate::Set(set) = &found.candidates[0] else { panic!("{found:?}") };
        assert_eq!(set.files.unlabelled, ["photo.jpg"]);
    }

    #[test]
    fn a_file_that_is_named_after_a_map_is_a_material_or_else_a_map_of_its_set() {
        let folder = folder(&MAPS);
        let found = located(&folder.path().join("a_normal.png"), &[]);
        assert_eq!(files(&found), [vec!["a_normal.png"], MAPS.to_vec()]);
        let other = located(&folder.path().join("a_normal.png"), &["normal=x.png"]);
        assert_eq!(files(&other), [vec!["a_normal.png"], vec!["a_diffuse.png", "a_roughness.png"]]);
    }

    #[test]
    fn the_only_folder_in_a_folder_without_pictures_is_entered() {
        let folder = folder(&["one/two/a_normal.png", "one/two/a_diffuse.png", "one/two/a_roughness.png"]);
        let found = located(folder.path(), &[]);
        assert_eq!(
            (files(&found), found.folders),
            (vec![MAPS.map(str::to_owned).to_vec()], vec!["one".to_owned(), "two".to_owned()])
        );
    }

    #[test]
    fn a_located_file_knows_who_named_it() {
        let folder = folder(&["a_diffuse.png", "a_roughness.png", "n.png", "m.png"]);
        let path = folder.path();
        let saved = Sidecar {
            bindings: vec![format!("normal={}", path.join("n.png").display()).parse().unwrap()],
            ..Sidecar::default()
        };
        let caller: Binding = "metallic=m.png".parse().unwrap();
        let used = Sidecar { bindings: vec![saved.bindings[0].clone(), caller], ..Sidecar::default() };
        let found = locate(path, &saved, &used).unwrap();
        let by: Vec<_> =
            found.bound.iter().map(|bound| bound.file.as_ref().unwrap().named_by().clone()).collect();
        assert_eq!(by, [NamedBy::File(path.join("svbrdf.json")), NamedBy::User]);
        let Candidate::Set(set) = &found.candidates[0] else { panic!("{found:?}") };
        assert_eq!(set.file("a_diffuse.png").named_by(), &NamedBy::File(path.to_owned()));
    }
}
