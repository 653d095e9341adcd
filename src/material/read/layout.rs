//! Where the four maps are: tiles of a packed strip, or one file a map in a folder or behind a common prefix.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use super::decode::{self, Raster};
use super::names::{Map, words};
use crate::error::Error;
use crate::progress::Progress;

/// Most file names that a message lists.
const MOST_LISTED: usize = 12;

/// The four maps as stored, in the order of [`Map::ALL`], each with the file that it is from.
#[derive(Debug)]
pub struct Found {
    pub name: String,
    pub maps: [Raster; 4],
    pub files: [PathBuf; 4],
    /// What the user may want to know, one sentence each.
    pub notes: Vec<String>,
}

/// Finds and decodes what `path` names: a packed strip, a folder, or the common prefix of four files.
///
/// # Errors
/// [`Error::Unreadable`], [`Error::BadImage`], [`Error::NotAMaterial`], [`Error::Cancelled`].
pub fn find(path: &Path, progress: &Progress) -> Result<Found, Error> {
    if path.is_dir() {
        return separate(path, path, "", progress);
    }
    if !path.exists()
        && let Some(prefix) = path.file_name()
    {
        let folder = path.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."));
        return separate(path, folder, &prefix.to_string_lossy(), progress);
    }
    progress.begin(1);
    let strip = decode::decode_file(path, "packed strip")?;
    progress.step()?;
    unpack(path, strip)
}

/// Takes a packed strip apart: photos, then normal | diffuse | roughness | specular, all square.
///
/// # Errors
/// [`Error::NotAMaterial`] where its width is no multiple of its height, or less than four times that.
pub fn unpack(path: &Path, strip: Raster) -> Result<Found, Error> {
    let (width, height) = (strip.width, strip.height);
    let tiles = width / height;
    if tiles < Map::ALL.len() || width % height != 0 {
        return Err(Error::NotAMaterial {
            path: path.to_owned(),
            expected: "a packed strip of square tiles, any photos and then normal | diffuse | roughness | specular, \
                4 or more times as wide as high"
                .to_owned(),
            found: format!("{width} x {height} pixels"),
            remedy: "correct the strip, or give a folder or prefix of one file a map".to_owned(),
        });
    }
    let photos = tiles - Map::ALL.len();
    let mut notes = vec![format!(
        "Read as a packed strip of {height} x {height} tiles: normal, diffuse, roughness, specular."
    )];
    if photos > 0 {
        notes.push(format!("The first {photos} of {tiles} tiles are taken as photos and ignored."));
    }
    let name = path.file_stem().unwrap_or(path.as_os_str()).to_string_lossy().into_owned();
    let maps = [0, 1, 2, 3].map(|i| strip.tile(photos + i));
    Ok(Found { name, maps, files: [0; 4].map(|_| path.to_owned()), notes })
}

/// Decodes one file a map out of `folder`, of the files whose names begin with `prefix`; `path` is what the user gave.
fn separate(path: &Path, folder: &Path, prefix: &str, progress: &Progress) -> Result<Found, Error> {
    let names = list(path, folder, prefix)?;
    if names.is_empty() && !prefix.is_empty() {
        let absent = io::Error::new(io::ErrorKind::NotFound, "no file, folder or prefix of files is there");
        return Err(Error::unreadable(path, absent));
    }
    let [n, d, r, s] = Map::ALL.map(|map| claim(path, map, prefix, &names));
    let chosen = [n?, d?, r?, s?];
    progress.begin(Map::ALL.len() as u64);
    let load = |map: Map| {
        let raster = decode::decode_file(&folder.join(chosen[map as usize]), &format!("{} map", map.name()));
        progress.step().and(raster)
    };
    let [n, d, r, s] = Map::ALL;
    let maps = [load(n)?, load(d)?, load(r)?, load(s)?];
    let notes = Map::ALL.iter().zip(chosen).map(|(map, file)| format!("The {} map is {file}.", map.name()));
    Ok(Found {
        name: material_name(path, prefix),
        maps,
        notes: notes.collect(),
        files: chosen.map(|name| folder.join(name)),
    })
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

/// The one PNG file among `names` that holds `map`.
fn claim<'a>(path: &Path, map: Map, prefix: &str, names: &'a [String]) -> Result<&'a str, Error> {
    let holds = |name: &&String| {
        let file = Path::new(name.as_str());
        let png = file.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("png"));
        let stem = file.file_stem().unwrap_or_default().to_string_lossy();
        png && Map::of_words(&words(stem.strip_prefix(prefix).unwrap_or(""))) == Some(map)
    };
    let mut holding = names.iter().filter(holds);
    let expected = format!("one PNG file for the {} map (named {})", map.name(), map.words().join(", "));
    match (holding.next(), holding.next()) {
        (Some(name), None) => Ok(name),
        (Some(first), Some(second)) => Err(Error::NotAMaterial {
            path: path.to_owned(),
            expected,
            found: format!("{first} and {second}"),
            remedy: "give the prefix that only the files of this material share, or move one away".to_owned(),
        }),
        (None, _) => Err(Error::NotAMaterial {
            path: path.to_owned(),
            expected,
            found: listing(names),
            remedy: "add or rename the file".to_owned(),
        }),
    }
}

/// The file names for a message, no matter how many they are.
fn listing(names: &[String]) -> String {
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
    let resolved = path.canonicalize().unwrap_or_else(|_| path.to_owned());
    resolved.file_name().unwrap_or(path.as_os_str()).to_string_lossy().into_owned()
}
