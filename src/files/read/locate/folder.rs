//! One file a map: in a folder, behind a common prefix, or around one of the files.

use std::io;
use std::path::Path;

use rayon::prelude::*;

use super::binding;
use super::directory::{self, list, listing, material_name};
use super::grouping::{self, Named, Set};
use super::names::{Label, Role};
use crate::error::Error;
use crate::files::read::assumption::{Assumption, Certainty, What};
use crate::files::read::decode;
use crate::files::read::interpret::detect::{NORMAL_AT_LEAST, normal_score};
use crate::files::read::options::{Albedo, NormalY, ReadOptions, Reflectance, Roughness, Workflow};
use crate::files::read::stored::{Found, Hints, Pictures, Source};
use crate::progress::Progress;

/// A picture whose name says nothing is the normal map where this share of its pixels looks like normals.
const NORMAL_ALL_OVER: f64 = 0.95;

/// Reads the maps in `folder` whose file names begin with `prefix`; `path` is what the user gave.
///
/// # Errors
/// As `read`.
pub fn open(
    path: &Path,
    folder: &Path,
    prefix: &str,
    bound: Vec<(Role, Source)>,
    options: &ReadOptions,
    progress: &Progress,
) -> Result<Found, Error> {
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
    if prefix.is_empty() && set.files.is_empty() && bound.is_empty() && !set.riddles.is_empty() {
        match open_packed(path, folder, &set.riddles, options, progress) {
            Err(Error::NotAMaterial { .. }) if set.riddles.len() == 1 => {}
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
    bound: Vec<(Role, Source)>,
    options: &ReadOptions,
    progress: &Progress,
) -> Result<Found, Error> {
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
    found.notes.insert(0, format!("The maps are in the folder {only} within."));
    Ok(Found { name: material_name(path, ""), ..found })
}

/// Reads the only one of `pictures`, whose names say no map.
fn open_packed(
    path: &Path,
    folder: &Path,
    pictures: &[String],
    options: &ReadOptions,
    progress: &Progress,
) -> Result<Found, Error> {
    let [only] = pictures else {
        return Err(Error::NotAMaterial {
            path: path.to_owned(),
            expected: "the maps of one material, named so".to_owned(),
            found: format!("several pictures whose names say no map: {}", listing(pictures)),
            remedy: "open one of them if each is a material, or rename them".to_owned(),
        });
    };
    crate::files::read::find_in_picture(&folder.join(only), options, progress)
}

/// Reads the set of maps that the file `path` belongs to by its name; `None` where its name says nothing.
///
/// # Errors
/// As `read`.
pub fn open_around(
    path: &Path,
    bound: Vec<(Role, Source)>,
    options: &ReadOptions,
    progress: &Progress,
) -> Option<Result<Found, Error>> {
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
    /// Maps that the user named.
    bound: Vec<(Role, Source)>,
    /// What there is, for messages.
    names: &'a [String],
    options: &'a ReadOptions,
}

impl Assembly<'_> {
    fn read(self, progress: &Progress) -> Result<Found, Error> {
        let Self { path, folder, name, set, bound, names, options } = self;
        progress.begin(set.files.len() as u64);
        let load = |named: &Named| {
            let what = format!("{} map", named.label.role.name());
            let decoded = decode::decode_one(&folder.join(&named.file), &what);
            progress.step().and(decoded)
        };
        let decoded: Vec<_> = set.files.par_iter().map(load).collect::<Result<_, _>>()?;
        let mut pictures = Pictures::default();
        let mut notes = Vec::new();
        let mut floats = true;
        let is_opensvbrdf = set.files.iter().any(|f| f.label.word == "axay");
        for (named, (mut raster, said)) in set.files.iter().zip(decoded) {
            let Named { file, label } = named;
            notes.push(format!("The {} map is {file}.", label.role.name()));
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
                notes.push(format!("{file} is taken as a factor on 0.04, as OpenSVBRDF writes it."));
            }
            pictures.add(label.role, Source { raster, file: folder.join(file), part: String::new() });
        }
        // Who names a map of specular wants it to be used.
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
        for riddle in set.riddles {
            let rescued = if pictures.has(Role::Normal) { None } else { rescued(&folder.join(&riddle)) };
            let Some(source) = rescued else {
                notes.push(format!("{riddle} is not used: its name says no map."));
                continue;
            };
            pictures.add(Role::Normal, source);
            let why = "nearly all of its pixels look like normals, though its name says no map";
            doubts.push(Assumption::new(What::Layout, format!("normal is {riddle}"), why, Certainty::Unsure));
        }
        let mut found = pictures.into_found(path, name, &listing(names), options)?;
        found.assumptions.append(&mut doubts);
        found.hints = hints(folder, &set.files, floats);
        if is_diffmat(&set.files, &found) {
            let why = "DiffMat writes these names and depths, and y down unless told otherwise";
            found.hints.albedo = Some((Albedo::Gamma22, why.to_owned(), Certainty::Likely));
            found.hints.normal_y = Some((NormalY::Down, why.to_owned(), Certainty::Unsure));
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
fn rescued(file: &Path) -> Option<Source> {
    let (raster, _) = decode::decode_one(file, "picture").ok()?;
    let score = normal_score(&raster);
    (score > NORMAL_ALL_OVER).then(|| Source { raster, file: file.to_owned(), part: String::new() })
}

/// Whether the files look as DiffMat writes them: whole names, colour in 8 bits, gray in 16.
fn is_diffmat(files: &[Named], found: &Found) -> bool {
    let plain = ["basecolor", "normal", "roughness", "metallic"];
    let deep = |source: &Source| source.raster.depth == "16-bit" && source.raster.channels.len() == 1;
    files.iter().all(|f| f.label.stem.is_empty() && plain.contains(&f.label.word.as_str()))
        && found.colour.raster.depth == "8-bit"
        && deep(&found.roughness)
        && found.metallic.as_ref().is_some_and(deep)
}

/// What the names say about the values.
fn hints(folder: &Path, files: &[Named], floats: bool) -> Hints {
    let word = |role: Role| files.iter().find(|f| f.label.role == role).map(|f| f.label.word.as_str());
    let said =
        |f: &Named| f.label.roughness().map(|r| (r, format!("{} is called so", f.file), Certainty::Sure));
    let roughness = files.iter().find_map(said);
    let normal_y = files.iter().find_map(|f| f.label.normal_y.map(|y| (f, y))).map(|(f, y)| {
        let seen = if y == NormalY::Up { "OpenGL" } else { "DirectX" };
        (y, format!("{} is called {seen}", f.file), Certainty::Sure)
    });
    let mut hints = Hints { roughness, normal_y, ..Hints::default() };
    if floats {
        hints.albedo = Some((Albedo::Linear, "floats are linear".to_owned(), Certainty::Likely));
        hints.specular = hints.albedo.clone();
        return hints;
    }
    let colour = word(Role::Diffuse).or(word(Role::Base)).unwrap_or_default();
    let choice = if word(Role::Normal) == Some("nom") && word(Role::Roughness) == Some("rgh") {
        let why = "MaterialGAN and its heirs use these names and store so";
        hints.roughness = Some((Roughness::Gamma22, why.to_owned(), Certainty::Likely));
        Some((Albedo::Gamma22, why, Certainty::Likely))
    } else if colour == grouping::NUMBERED {
        Some((Albedo::Gamma22, "the results of Deschaintre et al. 2020 are numbered so", Certainty::Unsure))
    } else if colour.contains("gammad") {
        Some((Albedo::Gamma22, "the names say gammad", Certainty::Sure))
    } else if colour.starts_with("outputs") || colour.starts_with("targets") {
        Some((
            Albedo::Linear,
            "the networks of Deschaintre et al. write these names, linear",
            Certainty::Likely,
        ))
    } else if word(Role::Specular) == Some("specular") && folder.join("render").is_dir() {
        Some((Albedo::Linear, "SurfaceNet's data sets look so, and are linear", Certainty::Likely))
    } else {
        None
    };
    hints.albedo = choice.map(|(albedo, why, certainty)| (albedo, why.to_owned(), certainty));
    hints.specular = hints.albedo.clone();
    hints
}
