//! One file a map: in a folder, behind a common prefix, or around one of the files.

use std::io;
use std::path::Path;

use rayon::prelude::*;

use super::binding;
use super::directory::{self, list, listing, material_name};
use super::grouping::{self, Named, Set};
use super::names::{Label, Role};
use super::picture;
use super::reading::{Reading, is_colour};
use crate::error::Error;
use crate::files::read::assumption::Certainty;
use crate::files::read::decode;
use crate::files::read::interpret::detect::{NORMAL_AT_LEAST, normal_score};
use crate::files::read::note::{Note, Subject};
use crate::files::read::options::{Albedo, NormalY, ReadOptions, Roughness, Workflow};
use crate::files::read::reason::Reason;
use crate::files::read::storage_convention::StorageConvention;
use crate::files::read::stored::{Inferences, StoredMap, StoredMaterial};
use crate::progress::Progress;

/// Reads the maps in `folder` whose file names begin with `prefix`; `path` is what the user gave.
///
/// # Errors
/// As `read`.
pub(crate) fn open(
    path: &Path,
    folder: &Path,
    prefix: &str,
    bound: Vec<(Role, StoredMap)>,
    options: &ReadOptions,
    progress: &Progress,
) -> Result<StoredMaterial, Error> {
    let mut names = list(path, folder, prefix)?;
    if prefix.is_empty() && !names.iter().any(|name| grouping::is_picture(name)) {
        let folders = directory::folders(folder)?;
        if !folders.is_empty() {
            return open_within(path, folder, &folders, bound, options, progress);
        }
    }
    if names.is_empty() && !prefix.is_empty() {
        let absent = io::Error::new(io::ErrorKind::NotFound, "no file, folder or prefix of files is there");
        return Err(Error::unreadable(path, absent));
    }
    if !prefix.is_empty() {
        let others =
            list(path, folder, "")?.into_iter().filter(|name| grouping::is_shared_with(name, prefix));
        names.extend(others);
        names.sort();
        names.dedup();
    }
    let roles: Vec<_> = bound.iter().map(|(role, _)| *role).collect();
    let set = grouping::choose(path, &names, None, &roles)?;
    if prefix.is_empty() && set.files.is_empty() && bound.is_empty() && !set.unlabelled.is_empty() {
        match open_packed(path, folder, &set.unlabelled, options, progress) {
            Err(Error::NotAMaterial { .. } | Error::NotPacked { .. }) if set.unlabelled.len() == 1 => {
                return Err(lone_picture(path, &names, &set.unlabelled[0]));
            }
            found => return found,
        }
    }
    let name = material_name(path, prefix);
    Assembly { path, folder, name, set, bound, names: &names, options }.read(progress)
}

/// A picture in a folder of its own that is not packed, and whose name names no map.
fn lone_picture(path: &Path, names: &[String], picture: &str) -> Error {
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

/// Reads the material of the only one of `folders` within a folder without pictures.
fn open_within(
    path: &Path,
    folder: &Path,
    folders: &[String],
    bound: Vec<(Role, StoredMap)>,
    options: &ReadOptions,
    progress: &Progress,
) -> Result<StoredMaterial, Error> {
    let [only] = folders else {
        return Err(Error::NotAMaterial {
            path: path.to_owned(),
            expected: "pictures".to_owned(),
            found: format!("none, but the folders {}", listing(folders)),
            remedy: "open one of them".to_owned(),
        });
    };
    let within = folder.join(only);
    let mut found = open(&within, &within, "", bound, options, progress)?;
    found.notes.insert(0, Note::InFolder { folder: only.clone() });
    Ok(StoredMaterial { name: material_name(path, ""), ..found })
}

/// Reads the only one of `pictures`, whose names name no map.
fn open_packed(
    path: &Path,
    folder: &Path,
    pictures: &[String],
    options: &ReadOptions,
    progress: &Progress,
) -> Result<StoredMaterial, Error> {
    let [only] = pictures else {
        return Err(Error::NotAMaterial {
            path: path.to_owned(),
            expected: "files named after the maps of one material".to_owned(),
            found: format!("several pictures whose names name no map: {}", listing(pictures)),
            remedy: "open one of them if each is a material, or rename them".to_owned(),
        });
    };
    picture::open(&folder.join(only), options, progress)
}

/// Reads the set of maps that the file `path` belongs to by its name; `None` where its name names no map.
///
/// # Errors
/// As `read`.
pub(crate) fn open_around(
    path: &Path,
    bound: Vec<(Role, StoredMap)>,
    options: &ReadOptions,
    progress: &Progress,
) -> Option<Result<StoredMaterial, Error>> {
    let stem = path.file_stem()?.to_string_lossy();
    let label = Label::of(&stem)?;
    let folder = path.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let read = || {
        let names = list(path, folder, "")?;
        let roles: Vec<_> = bound.iter().map(|(role, _)| *role).collect();
        let set = grouping::choose(path, &names, Some(&label.stem), &roles)?;
        let name = if label.stem.is_empty() { material_name(folder, "") } else { label.stem.join(" ") };
        Assembly { path, folder, name, set, bound, names: &names, options }.read(progress)
    };
    Some(read())
}

/// The files of a material, chosen.
struct Assembly<'a> {
    path: &'a Path,
    folder: &'a Path,
    name: String,
    set: Set,
    /// Maps that were specified one by one.
    bound: Vec<(Role, StoredMap)>,
    /// The files of the folder, for messages.
    names: &'a [String],
    options: &'a ReadOptions,
}

impl Assembly<'_> {
    fn read(self, progress: &Progress) -> Result<StoredMaterial, Error> {
        let Self { path, folder, name, set, bound, names, options } = self;
        progress.begin(set.files.len() as u64);
        let load = |named: &Named| {
            let what = Subject::Map(named.label.role);
            let decoded = decode::decode_one(&folder.join(&named.file), what);
            progress.step().and(decoded)
        };
        let decoded: Vec<_> = set.files.par_iter().map(load).collect::<Result<_, _>>()?;
        let mut reading = Reading::new(folder, &set.files);
        for (named, (raster, said)) in set.files.iter().zip(decoded) {
            let (named, raster, said) = match reading.other_normals(&set, named, &raster) {
                Some((other, raster, said)) => (other, raster, said),
                None => (named, raster, said),
            };
            if reading.is_contested(&set, named) {
                return Err(two_pictures(path, named, &set.normals[0]));
            }
            reading.notes.extend(said);
            if named.label.word == grouping::NUMBERED
                && named.label.role == Role::Normal
                && normal_score(&raster) < NORMAL_AT_LEAST
            {
                return Err(numbers_mislead(path, &named.file));
            }
            reading.add(named, raster);
        }
        // Whoever specifies a specular map wants it to be used.
        let named = bound.iter().any(|(role, _)| *role == Role::Specular) && options.workflow.is_none();
        let options = &ReadOptions {
            workflow: if named { Some(Workflow::Specular) } else { options.workflow },
            ..*options
        };
        for (role, source) in bound {
            reading.notes.push(binding::note(role, &source.file));
            reading.floats &= source.raster.is_float() || !is_colour(role);
            reading.pictures.replace(role, source);
        }
        for file in &set.unlabelled {
            reading.rescue(file);
        }
        let Reading { pictures, mut notes, floats, mut doubts, is_glossy, .. } = reading;
        let mut found = pictures.assemble(path, name, &listing(names), options)?;
        found.assumptions.append(&mut doubts);
        found.inferred = inferred(folder, &set.files, floats);
        if is_diffmat(&set.files, &found) {
            let why = || StorageConvention::DiffMatNames.into();
            found.inferred.albedo = Some((Albedo::Gamma22, why(), Certainty::Likely));
            found.inferred.normal_y = Some((NormalY::Down, why(), Certainty::Unsure));
        }
        if is_glossy {
            let why = || StorageConvention::SpecularGlossiness.into();
            found.inferred.albedo = Some((Albedo::Srgb, why(), Certainty::Sure));
            found.inferred.specular = found.inferred.albedo.clone();
            found.inferred.roughness = Some((Roughness::Gloss, why(), Certainty::Sure));
        }
        notes.extend(set.notes);
        notes.append(&mut found.notes);
        found.notes = notes;
        Ok(found)
    }
}

/// Two pictures of normals, neither of which is constant.
fn two_pictures(path: &Path, one: &Named, other: &Named) -> Error {
    let (first, second) = if one.file < other.file { (one, other) } else { (other, one) };
    Error::NotAMaterial {
        path: path.to_owned(),
        expected: "one picture for the normal map".to_owned(),
        found: format!("{} and {}", first.file, second.file),
        remedy: "give the prefix that only the files of this material share, or move one away".to_owned(),
    }
}

fn numbers_mislead(path: &Path, file: &str) -> Error {
    Error::NotAMaterial {
        path: path.to_owned(),
        expected: "files 0 to 3 to be normal, diffuse, roughness and specular".to_owned(),
        found: format!("{file} without the look of normals"),
        remedy: "name the files by their maps".to_owned(),
    }
}

/// Whether the files look as DiffMat writes them: whole names, colour in 8 bits, gray in 16.
fn is_diffmat(files: &[Named], found: &StoredMaterial) -> bool {
    let plain = ["basecolor", "normal", "roughness", "metallic"];
    let deep = |source: &StoredMap| source.raster.depth == "16-bit" && source.raster.channels.len() == 1;
    files.iter().all(|f| f.label.stem.is_empty() && plain.contains(&f.label.word.as_str()))
        && found.colour.raster.depth == "8-bit"
        && deep(&found.roughness)
        && found.metallic.as_ref().is_some_and(deep)
}

/// What the names tell about the values.
fn inferred(folder: &Path, files: &[Named], floats: bool) -> Inferences {
    let word = |role: Role| files.iter().find(|f| f.label.role == role).map(|f| f.label.word.as_str());
    let named = |f: &Named| {
        f.label.roughness().map(|r| (r, Reason::FileName { file: f.file.clone() }, Certainty::Sure))
    };
    let roughness = files.iter().find_map(named);
    let normal_y = files.iter().find_map(|f| f.label.normal_y.map(|y| (f, y)));
    let normal_y =
        normal_y.map(|(f, y)| (y, Reason::NormalName { file: f.file.clone(), y }, Certainty::Sure));
    let mut inferred = Inferences { roughness, normal_y, ..Inferences::default() };
    if floats {
        inferred.albedo = Some((Albedo::Linear, StorageConvention::Floats.into(), Certainty::Likely));
        inferred.specular = inferred.albedo.clone();
        return inferred;
    }
    let colour = word(Role::Diffuse).or(word(Role::Base)).unwrap_or_default();
    let choice = if word(Role::Normal) == Some("nom") && word(Role::Roughness) == Some("rgh") {
        let why = StorageConvention::MaterialGanNames;
        inferred.roughness = Some((Roughness::Gamma22, why.into(), Certainty::Likely));
        Some((Albedo::Gamma22, why, Certainty::Likely))
    } else if colour == grouping::NUMBERED {
        Some((Albedo::Gamma22, StorageConvention::NumberedResults, Certainty::Unsure))
    } else if colour.contains("gammad") {
        Some((Albedo::Gamma22, StorageConvention::GammadNames, Certainty::Sure))
    } else if colour.starts_with("outputs") || colour.starts_with("targets") {
        Some((Albedo::Linear, StorageConvention::DeschaintreNames, Certainty::Likely))
    } else if word(Role::Specular) == Some("specular") && folder.join("render").is_dir() {
        Some((Albedo::Linear, StorageConvention::SurfaceNetFolder, Certainty::Likely))
    } else {
        None
    };
    inferred.albedo = choice.map(|(albedo, why, certainty)| (albedo, why.into(), certainty));
    inferred.specular = inferred.albedo.clone();
    inferred
}
