//! One file a map: in a folder, behind a common prefix, or around one of the files.

use std::io;
use std::path::Path;

use rayon::prelude::*;

use super::binding;
use super::directory::{self, list, listing, material_name};
use super::grouping::{self, Named, Set};
use super::names::{Label, Role};
use super::picture;
use crate::error::Error;
use crate::files::read::assumption::{Assumption, Certainty, What};
use crate::files::read::decode;
use crate::files::read::interpret::detect::{NORMAL_AT_LEAST, normal_score};
use crate::files::read::note::{Note, Subject, Unused};
use crate::files::read::options::{Albedo, NormalY, ReadOptions, Reflectance, Roughness, Workflow};
use crate::files::read::reason::{Reason, StorageConvention};
use crate::files::read::stored::{Inferences, Pictures, StoredMap, StoredMaterial};
use crate::progress::Progress;

/// An unlabelled picture is the normal map where this share of its pixels looks like normals.
const NORMAL_ALL_OVER: f64 = 0.95;

/// Reads the maps in `folder` whose file names begin with `prefix`; `path` is what the user gave.
///
/// # Errors
/// As `read`.
pub fn open(
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
            Err(Error::NotAMaterial { .. } | Error::NotPacked { .. }) if set.unlabelled.len() == 1 => {}
            found => return found,
        }
    }
    let name = material_name(path, prefix);
    Assembly { path, folder, name, set, bound, names: &names, options }.read(progress)
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
pub fn open_around(
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
        let mut pictures = Pictures::default();
        let mut notes = Vec::new();
        let mut floats = true;
        let is_opensvbrdf = set.files.iter().any(|f| f.label.word == "axay");
        for (named, (mut raster, said)) in set.files.iter().zip(decoded) {
            let Named { file, label } = named;
            notes.push(Note::MapFile { map: label.role, file: file.clone() });
            notes.extend(said);
            floats &= raster.is_float() || !is_colour(label.role);
            if label.word == grouping::NUMBERED
                && label.role == Role::Normal
                && normal_score(&raster) < NORMAL_AT_LEAST
            {
                return Err(numbers_mislead(path, file));
            }
            if is_opensvbrdf && label.word == "ps" {
                raster = raster.scaled(&[Reflectance::DIELECTRIC.value() as f32]);
                notes.push(Note::SpecularFactor { file: file.clone() });
            }
            pictures.add(label.role, StoredMap { raster, file: folder.join(file), part: String::new() });
        }
        // Whoever specifies a specular map wants it to be used.
        let named = bound.iter().any(|(role, _)| *role == Role::Specular) && options.workflow.is_none();
        let options = &ReadOptions {
            workflow: if named { Some(Workflow::Specular) } else { options.workflow },
            ..*options
        };
        for (role, source) in bound {
            notes.push(binding::note(role, &source.file));
            floats &= source.raster.is_float() || !is_colour(role);
            pictures.replace(role, source);
        }
        let mut doubts = Vec::new();
        for file in set.unlabelled {
            let rescued = if pictures.has(Role::Normal) { None } else { rescued(&folder.join(&file)) };
            let Some(source) = rescued else {
                notes.push(Note::Unused { what: file, why: Unused::Unlabelled });
                continue;
            };
            pictures.add(Role::Normal, source);
            let chosen = format!("normal is {file}");
            doubts.push(Assumption::new(What::Layout, chosen, Reason::NormalPixels, Certainty::Unsure));
        }
        let mut found = pictures.assemble(path, name, &listing(names), options)?;
        found.assumptions.append(&mut doubts);
        found.inferred = inferred(folder, &set.files, floats);
        if is_diffmat(&set.files, &found) {
            let why = || StorageConvention::DiffMatNames.into();
            found.inferred.albedo = Some((Albedo::Gamma22, why(), Certainty::Likely));
            found.inferred.normal_y = Some((NormalY::Down, why(), Certainty::Unsure));
        }
        notes.extend(set.notes);
        notes.append(&mut found.notes);
        found.notes = notes;
        Ok(found)
    }
}

fn is_colour(role: Role) -> bool {
    matches!(role, Role::Base | Role::Diffuse | Role::Specular)
}

fn numbers_mislead(path: &Path, file: &str) -> Error {
    Error::NotAMaterial {
        path: path.to_owned(),
        expected: "files 0 to 3 to be normal, diffuse, roughness and specular".to_owned(),
        found: format!("{file} without the look of normals"),
        remedy: "name the files by their maps".to_owned(),
    }
}

/// The picture `file`, if it looks like a normal map all over.
fn rescued(file: &Path) -> Option<StoredMap> {
    let (raster, _) = decode::decode_one(file, Subject::Picture).ok()?;
    let score = normal_score(&raster);
    (score > NORMAL_ALL_OVER).then(|| StoredMap { raster, file: file.to_owned(), part: String::new() })
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
