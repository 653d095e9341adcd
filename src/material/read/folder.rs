//! One file a map: in a folder, behind a common prefix, or around one of the files.

use std::collections::BTreeMap;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use rayon::prelude::*;

use super::assumption::Certainty;
use super::decode;
use super::found::{Found, Hints, Pictures, Source};
use super::names::{Label, Role, words};
use super::options::{Albedo, NormalY, Roughness};
use crate::error::Error;
use crate::progress::Progress;

/// Most file names that a message lists.
const MOST_LISTED: usize = 12;
/// Extensions of the pictures that count, the better one of two last.
const EXTENSIONS: [&str; 8] = ["jpg", "jpeg", "hdr", "png", "tif", "tiff", "npy", "exr"];

/// A file that its name says to be a map.
#[derive(Clone, Debug)]
struct Named {
    file: String,
    label: Label,
}

impl Named {
    /// The higher, the better a source for its map.
    fn rank(&self) -> (u8, Option<usize>) {
        let extension =
            Path::new(&self.file).extension().unwrap_or_default().to_string_lossy().to_lowercase();
        (self.label.rank(), EXTENSIONS.iter().position(|e| *e == extension))
    }
}

/// Which files of a folder are one material.
struct Set {
    files: Vec<Named>,
    notes: Vec<String>,
}

/// Reads the maps in `folder` whose file names begin with `prefix`; `path` is what the user gave.
///
/// # Errors
/// As `read`.
pub fn open(path: &Path, folder: &Path, prefix: &str, progress: &Progress) -> Result<Found, Error> {
    let names = list(path, folder, prefix)?;
    if names.is_empty() && !prefix.is_empty() {
        let absent = io::Error::new(io::ErrorKind::NotFound, "no file, folder or prefix of files is there");
        return Err(Error::unreadable(path, absent));
    }
    let set = choose(path, &names, None)?;
    assemble(path, folder, material_name(path, prefix), set, &names, progress)
}

/// Reads the set of maps that the file `path` belongs to by its name; `None` where its name says nothing.
///
/// # Errors
/// As `read`.
pub fn open_around(path: &Path, progress: &Progress) -> Option<Result<Found, Error>> {
    let stem = path.file_stem()?.to_string_lossy();
    let label = Label::of(&stem)?;
    let folder = path.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let read = || {
        let names = list(path, folder, "")?;
        let set = choose(path, &names, Some(&label.stem))?;
        let name = if label.stem.is_empty() { material_name(folder, "") } else { label.stem.join(" ") };
        assemble(path, folder, name, set, &names, progress)
    };
    Some(read())
}

/// The names of the visible files in `folder` that begin with `prefix` and whose next word begins there, sorted.
///
/// Where there is no such folder, the error names `path`, which the user gave.
fn list(path: &Path, folder: &Path, prefix: &str) -> Result<Vec<String>, Error> {
    let unreadable = |source| Error::unreadable(if folder.is_dir() { folder } else { path }, source);
    let prefix_words = words(prefix);
    let mut names = Vec::new();
    for entry in fs::read_dir(folder).map_err(unreadable)? {
        let entry = entry.map_err(unreadable)?;
        let name = entry.file_name().to_string_lossy().into_owned();
        let begins = name.starts_with(prefix) && words(&name).starts_with(&prefix_words);
        if begins && !name.starts_with('.') && !entry.path().is_dir() {
            names.push(name);
        }
    }
    names.sort();
    Ok(names)
}

fn is_picture(name: &str) -> bool {
    let extension = Path::new(name).extension().unwrap_or_default().to_string_lossy().to_lowercase();
    EXTENSIONS.contains(&extension.as_str())
}

/// The files of the one material among `names`: of the stem `wanted`, or of the only stem that is complete.
fn choose(path: &Path, names: &[String], wanted: Option<&[String]>) -> Result<Set, Error> {
    let mut groups: BTreeMap<Vec<String>, Vec<Named>> = BTreeMap::new();
    let mut notes = Vec::new();
    for name in names.iter().filter(|name| is_picture(name)) {
        let stem = Path::new(name).file_stem().unwrap_or_default().to_string_lossy();
        match Label::of(&stem) {
            Some(label) => {
                groups.entry(label.stem.clone()).or_default().push(Named { file: name.clone(), label })
            }
            None => notes.push(format!("{name} is not used: its name says no map.")),
        }
    }
    groups.retain(|_, files| files.len() > 1 || !files[0].label.is_short());
    let complete: Vec<_> =
        groups.iter().filter(|(_, files)| is_complete(files)).map(|(stem, _)| stem).collect();
    let files = match (wanted, complete.as_slice()) {
        (Some(stem), _) => groups.remove(stem).unwrap_or_default(),
        (None, [only]) => {
            let only = (*only).clone();
            groups.remove(&only).unwrap_or_default()
        }
        (None, []) => groups.into_values().flatten().collect(),
        (None, several) => {
            let found = several.iter().map(|stem| stem.join("_")).collect::<Vec<_>>();
            return Err(Error::NotAMaterial {
                path: path.to_owned(),
                expected: "the maps of one material".to_owned(),
                found: format!("several: {}", listing(&found)),
                remedy: "give the prefix that only the files of one material share".to_owned(),
            });
        }
    };
    Ok(Set { files: best(path, files, &mut notes)?, notes })
}

fn is_complete(files: &[Named]) -> bool {
    let has = |roles: &[Role]| files.iter().any(|f| roles.contains(&f.label.role));
    has(&[Role::Base, Role::Diffuse])
        && has(&[Role::Roughness, Role::OcclusionRoughnessMetallic, Role::RoughnessMetallicOcclusion])
}

/// One file a map: the better of two, with a note; an error where neither is.
fn best(path: &Path, mut files: Vec<Named>, notes: &mut Vec<String>) -> Result<Vec<Named>, Error> {
    files.sort_by_key(Named::rank);
    let mut chosen: Vec<Named> = Vec::new();
    for file in files.into_iter().rev() {
        if file.label.role == Role::Ignored {
            notes.push(format!("{} is not used.", file.file));
            continue;
        }
        match chosen.iter().find(|c| c.label.role == file.label.role) {
            None => chosen.push(file),
            Some(better) if better.rank() > file.rank() => {
                notes.push(format!("{} is not used: {} is taken before it.", file.file, better.file));
            }
            Some(equal) => {
                let (first, second) = if file.file < equal.file { (&file, equal) } else { (equal, &file) };
                return Err(Error::NotAMaterial {
                    path: path.to_owned(),
                    expected: format!("one picture for the {} map", file.label.role.name()),
                    found: format!("{} and {}", first.file, second.file),
                    remedy: "give the prefix that only the files of this material share, or move one away"
                        .to_owned(),
                });
            }
        }
    }
    Ok(chosen)
}

fn assemble(
    path: &Path,
    folder: &Path,
    name: String,
    set: Set,
    names: &[String],
    progress: &Progress,
) -> Result<Found, Error> {
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
    for (named, (raster, said)) in set.files.iter().zip(decoded) {
        notes.push(format!("The {} map is {}.", named.label.role.name(), named.file));
        notes.extend(said);
        let is_colour = matches!(named.label.role, Role::Base | Role::Diffuse | Role::Specular);
        floats &= raster.is_float() || !is_colour;
        let file = folder.join(&named.file);
        pictures.add(named.label.role, Source { raster, file, part: String::new() });
    }
    let mut found = pictures.into_found(path, name, &listing(names))?;
    found.hints = hints(folder, &set.files, floats);
    if is_diffmat(&set.files, &found) {
        let why = "DiffMat writes these names and depths, and y down unless told otherwise";
        found.hints.albedo = Some((Albedo::Gamma22, why.to_owned(), Certainty::Likely));
        found.hints.normal_y = Some((NormalY::Down, why.to_owned(), Certainty::Unsure));
    }
    notes.extend(set.notes);
    found.notes = notes;
    Ok(found)
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

/// The file names for a message, no matter how many they are.
pub fn listing(names: &[String]) -> String {
    match names.len() {
        0 => "no files".to_owned(),
        count if count > MOST_LISTED => {
            format!("{} and {} more", names[..MOST_LISTED].join(", "), count - MOST_LISTED)
        }
        _ => names.join(", "),
    }
}

/// The prefix without separators at its end, or else the name of the folder.
fn material_name(path: &Path, prefix: &str) -> String {
    let prefix = prefix.trim_end_matches(|c: char| !c.is_alphanumeric());
    if !prefix.is_empty() {
        return prefix.to_owned();
    }
    // A folder such as `..` has a name only once it is resolved.
    let resolved: PathBuf = path.canonicalize().unwrap_or_else(|_| path.to_owned());
    resolved.file_name().unwrap_or(path.as_os_str()).to_string_lossy().into_owned()
}
