//! Sets of pictures, one file for each map: in a folder, behind a common prefix, or around one of the files.

use std::io;
use std::path::{Path, PathBuf};

use super::candidate::{Candidate, Located};
use super::picture::WholePicture;
use super::set::{self, Set, Wanted};
use crate::disk::atomic::folder_of;
use crate::disk::open::NamedFile;
use crate::error::Error;
use crate::read::names::{Label, folders, list, listing, material_name};
use crate::read::options::Role;
use crate::read::record::{Note, Unused};

/// Locates the maps in `folder` whose file names begin with `prefix`; `path` is what the user gave.
///
/// # Errors
/// [`Error::Unreadable`], [`Error::NotAMaterial`].
pub(super) fn locate(path: &Path, folder: &Path, prefix: &str, bound: &[Role]) -> Result<Located, Error> {
    let mut names = list(path, folder, prefix)?;
    let has_pictures = names.iter().any(|name| set::is_picture(name));
    if prefix.is_empty() && !has_pictures {
        let within_it = folders(folder)?;
        if !within_it.is_empty() {
            return within(path, folder, &within_it, bound);
        }
    }
    if prefix.is_empty()
        && has_pictures
        && bound.is_empty()
        && let Some(found) = beside_previews(path, folder, &names)?
    {
        return Ok(found);
    }
    if names.is_empty() && !prefix.is_empty() {
        let absent = io::Error::new(io::ErrorKind::NotFound, "no file, folder or prefix of files is there");
        return Err(Error::unreadable(path, absent));
    }
    if !prefix.is_empty() {
        let others = list(path, folder, "")?.into_iter().filter(|name| set::is_shared_with(name, prefix));
        names.extend(others);
        names.sort();
        names.dedup();
    }
    let wanted = if prefix.is_empty() { Wanted::All } else { Wanted::Named(prefix) };
    let found = set::choose(path, folder, &names, wanted, bound)?;
    if prefix.is_empty() && found.files.is_empty() && bound.is_empty() && !found.unlabelled.is_empty() {
        let picture = lone_picture(path, folder, &names, &found.unlabelled)?;
        return Ok(Located::new([Candidate::Picture(picture)]));
    }
    // Its name, such as m.exr, may be that of a map by chance.
    let mut pictures = names.iter().filter(|name| set::is_picture(name));
    let packed = match (pictures.next(), pictures.next()) {
        (Some(only), None) if prefix.is_empty() && bound.is_empty() => {
            let file = NamedFile::by_file(folder.join(only), folder);
            Some(Candidate::Picture(WholePicture { file, refusal: None }))
        }
        _ => None,
    };
    Ok(Located::new(packed.into_iter().chain([Candidate::Set(found)])))
}

/// The only file of a folder without pictures and folders, as an archive or a glTF may be.
///
/// # Errors
/// [`Error::Unreadable`].
pub(super) fn only_file(folder: &Path) -> Result<Option<PathBuf>, Error> {
    let mut names = list(folder, folder, "")?;
    names.retain(|name| !set::is_beside(name));
    let is_alone = names.len() == 1 && !set::is_picture(&names[0]) && folders(folder)?.is_empty();
    let only = names.pop().filter(|_| is_alone).map(|name| folder.join(name));
    // A pipe would be waited for.
    Ok(only.filter(|only| only.is_file()))
}

/// The only one of `pictures`, whose names name no map: it may be packed.
fn lone_picture(
    path: &Path,
    folder: &Path,
    names: &[String],
    pictures: &[String],
) -> Result<WholePicture, Error> {
    let [only] = pictures else {
        return Err(Error::NotAMaterial {
            path: path.to_owned(),
            expected: "files named after the maps of one material".to_owned(),
            found: format!("several pictures whose names name no map: {}", listing(pictures)),
            remedy: "open one of them if each is a material, or rename them".to_owned(),
        });
    };
    let file = NamedFile::by_file(folder.join(only), folder);
    Ok(WholePicture { file, refusal: Some(not_packed(path, names, only)) })
}

/// The refusal of a picture in a folder of its own that is not packed, and whose name names no map.
fn not_packed(path: &Path, names: &[String], picture: &str) -> Error {
    let others: Vec<_> = names.iter().filter(|name| *name != picture).cloned().collect();
    let others = if others.is_empty() { String::new() } else { format!(", and {}", listing(&others)) };
    let stem = Path::new(picture).file_stem().unwrap_or_default().to_string_lossy();
    Error::NotAMaterial {
        path: path.to_owned(),
        expected: format!(
            "a packed picture, or one for the diffuse map (named after one of {}) and one for the roughness map ({})",
            Role::Base.examples(),
            Role::Roughness.examples()
        ),
        found: format!("{picture}, whose name names no map{others}"),
        remedy: format!("name it {stem}_basecolor if it is that, and add the roughness map"),
    }
}

/// Locates the material of the only one of `folders` within a folder without pictures.
fn within(path: &Path, folder: &Path, folders: &[String], bound: &[Role]) -> Result<Located, Error> {
    let [only] = folders else {
        let are_maps = folders.iter().filter(|name| Label::of(name).is_some()).count() > 1;
        let remedy = match are_maps {
            true => {
                "one folder per map is a data set: put the maps of one material into a folder of its own, or specify each map by its file"
            }
            false => "open one of them",
        };
        return Err(Error::NotAMaterial {
            path: path.to_owned(),
            expected: "pictures".to_owned(),
            found: format!("none, but the folders {}", listing(folders)),
            remedy: remedy.to_owned(),
        });
    };
    let within = folder.join(only);
    let mut found = locate(&within, &within, "", bound)?;
    found.folders.insert(0, only.clone());
    Ok(Located { name: Some(material_name(path, "")), ..found })
}

/// The material of the only folder with a whole set, where the pictures beside it name no map: they are previews.
fn beside_previews(path: &Path, folder: &Path, names: &[String]) -> Result<Option<Located>, Error> {
    let stem = |name: &str| Path::new(name).file_stem().unwrap_or_default().to_string_lossy().into_owned();
    let is_map = |name: &&String| {
        set::is_picture(name) && Label::of(&stem(name)).is_some_and(|label| label.role != Role::Ignored)
    };
    if names.iter().any(|name| is_map(&name)) {
        return Ok(None);
    }
    let of = |name: &String| Some((name.clone(), set_within(&folder.join(name))?));
    let mut sets: Vec<_> = folders(folder)?.iter().filter_map(of).collect();
    let Some((name, mut set)) = sets.pop().filter(|_| sets.is_empty()) else { return Ok(None) };
    let pictures: Vec<_> = names.iter().filter(|name| set::is_picture(name)).collect();
    let unused = |name: &&String| Note::Unused { what: (*name).clone(), why: Unused::NotAMap };
    set.notes.extend([Note::InFolder { folder: name }].into_iter().chain(pictures.iter().map(unused)));
    set.name = material_name(path, "");
    // One that nothing is known of may be packed.
    let unlabelled: Vec<_> = pictures.iter().filter(|name| Label::of(&stem(name)).is_none()).collect();
    let file = |name: &String| NamedFile::by_file(folder.join(name), folder);
    let packed = match unlabelled.as_slice() {
        [only] => Some(Candidate::Picture(WholePicture { file: file(only), refusal: None })),
        _ => None,
    };
    Ok(Some(Located::new(packed.into_iter().chain([Candidate::Set(set)]))))
}

/// The set of the folder, where its names are those of a whole one.
fn set_within(folder: &Path) -> Option<Set> {
    let names = list(folder, folder, "").ok()?;
    let found = set::choose(folder, folder, &names, Wanted::All, &[]).ok()?;
    set::is_complete(&found.files, &[]).then_some(found)
}

/// Locates the set of maps that the file `path` belongs to by its name.
///
/// # Errors
/// As [`locate`].
pub(super) fn around(path: &Path, bound: &[Role]) -> Result<Set, Error> {
    let folder = folder_of(path);
    let names = list(path, folder, "")?;
    let file = path.file_name().unwrap_or_default().to_string_lossy();
    set::choose(path, folder, &names, Wanted::SetOf(&file), bound)
}
