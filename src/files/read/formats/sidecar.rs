//! The sidecar file: the options of reading a material, saved beside it.

use std::fs;
use std::io::Write as _;
use std::path::{Path, PathBuf};

use serde_json::{Map, Value};

use svbrdf_core::error::Error as CoreError;
use svbrdf_core::progress::Progress;
use svbrdf_core::text::of_json;

use super::binding::Binding;
use crate::disk::atomic::{self, folder_of};
use crate::disk::open::{NamedBy, NamedFile};
use crate::disk::own;
use crate::error::Error;
use crate::read::names::{EXTENSIONS, Label};
use crate::read::options::ReadOptions;
use crate::read::record::{Assumption, Certainty, Note, SpecifiedBy, What};

/// The name of the file in a folder.
const IN_FOLDER: &str = "svbrdf.json";
/// What comes after the name of a file, or a prefix, without its extension.
const BESIDE: &str = ".svbrdf.json";
/// The key of the maps that are specified one by one.
const MAPS: &str = "maps";

/// How a material is read unless other options are specified: the content of its sidecar file.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Sidecar {
    pub options: ReadOptions,
    pub bindings: Vec<Binding>,
}

impl Sidecar {
    /// The sidecar file of the material `path`: `svbrdf.json` in a folder, `NAME.svbrdf.json` beside a file `NAME.png` or
    /// the files of a prefix `NAME_`. Where a file or prefix has none of its own, that of its folder, where this exists.
    pub fn path_for(path: &Path) -> PathBuf {
        let own = own_place(path);
        let common = common_place(path);
        common.filter(|common| !own.exists() && common.exists()).unwrap_or(own)
    }

    /// Whether `path` is named like a sidecar file.
    pub fn is_named(path: &Path) -> bool {
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        name == IN_FOLDER || name.ends_with(BESIDE)
    }

    /// Reads the sidecar file of the material `path`; the default where there is none.
    ///
    /// # Errors
    /// [`Error::Unreadable`], [`Error::BadSidecar`].
    pub fn load(path: &Path) -> Result<Self, Error> {
        let place = Self::path_for(path);
        if !place.exists() && place != path {
            return Ok(Self::default());
        }
        let file = match place == path {
            true => NamedFile::by_user(&place),
            false => NamedFile::by_file(&place, path),
        };
        let text = file.text()?;
        let bad =
            |problem: String| Error::BadSidecar { path: place.clone(), problem, keys: keys().join(", ") };
        let mut all: Map<String, Value> = serde_json::from_str(&text).map_err(|e| bad(of_json(&e)))?;
        let mut sidecar = Self::default();
        let maps = all.remove(MAPS).unwrap_or_else(|| Map::new().into());
        let maps =
            maps.as_object().ok_or_else(|| bad(format!("expected an object after {MAPS}, found {maps}")))?;
        for (map, file) in maps {
            let file = file
                .as_str()
                .ok_or_else(|| bad(format!("{map}: expected FILE or FILE:PART, found {file}")))?;
            let binding: Binding =
                format!("{map}={file}").parse().map_err(|e: CoreError| bad(e.to_string()))?;
            sidecar.bindings.push(binding.named_by(&place)?);
        }
        // One by one, so that an error can name the key.
        for (key, value) in &all {
            if !keys().contains(key) {
                return Err(bad(format!("unknown key `{key}`")));
            }
            let one = Value::from(Map::from_iter([(key.clone(), value.clone())]));
            serde_json::from_value::<ReadOptions>(one).map_err(|e| bad(format!("{key}: {e}")))?;
        }
        sidecar.options = serde_json::from_value(all.into()).map_err(|e| bad(of_json(&e)))?;
        if common_place(path).is_some_and(|common| common == place) && !is_named_after_map(path) {
            // The maps of the folder are those of another material.
            sidecar.bindings.clear();
        }
        Ok(sidecar)
    }

    /// Checks that every file exists that the sidecar file of `path` names.
    ///
    /// # Errors
    /// [`Error::BadSidecar`].
    pub(crate) fn check_maps(&self, path: &Path) -> Result<(), Error> {
        let mut files = self.bindings.iter().filter_map(|binding| Some((binding.role(), binding.file()?)));
        match files.find(|(_, file)| *file.named_by() != NamedBy::User && !file.exists()) {
            Some((role, file)) => Err(Error::BadSidecar {
                path: Self::path_for(path),
                problem: format!("the {} map {} does not exist", role.name(), file.path().display()),
                keys: keys().join(", "),
            }),
            None => Ok(()),
        }
    }

    /// `options` and `bindings`, and its own where these specify nothing.
    #[must_use]
    pub fn overridden_by(self, options: &ReadOptions, bindings: &[Binding]) -> Self {
        let replaced = |old: &Binding| bindings.iter().any(|new| new.role() == old.role());
        let old = self.bindings.into_iter().filter(|old| !replaced(old));
        Self { options: options.over(self.options), bindings: old.chain(bindings.iter().cloned()).collect() }
    }

    /// Writes the sidecar file of the material `path`; returns its path.
    ///
    /// # Errors
    /// [`Error::Unwritable`], also where it is a link; [`Cancelled`](Error::is_cancelled).
    pub fn save(&self, path: &Path, progress: &Progress) -> Result<PathBuf, Error> {
        // What is saved for one file of a folder is not for the others; a map stands for its folder.
        let place = if is_named_after_map(path) { Self::path_for(path) } else { own_place(path) };
        own::check(&place)?;
        let mut all = self.options.object();
        all.retain(|_, value| !value.is_null());
        let folder = place.parent().unwrap_or(Path::new(""));
        let maps = self.bindings.iter().map(|binding| {
            let (map, file) = binding.relative_to(folder);
            (map.to_owned(), Value::from(file))
        });
        let maps = Map::from_iter(maps);
        if !maps.is_empty() {
            all.insert(MAPS.to_owned(), maps.into());
        }
        let text = format!("{:#}\n", Value::from(all));
        atomic::update(&place, progress, |file| file.write_all(text.as_bytes()))?;
        Ok(place)
    }

    /// Attributes the assumptions and notes that come from here to the sidecar `file`; `options` are those that the
    /// material was read with.
    pub(crate) fn attribute(
        &self,
        file: &Path,
        options: &ReadOptions,
        assumptions: &mut [Assumption],
        notes: &mut Vec<Note>,
    ) {
        let name = file.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let sidecar = SpecifiedBy::Sidecar(name);
        let (saved, used) = (self.options.with_preset().object(), options.with_preset().object());
        let is_saved =
            |key: &str| saved.get(key).is_some_and(|value| !value.is_null() && used.get(key) == Some(value));
        let is_any_saved = |what: What| {
            let mut keys = what.keys().iter();
            keys.find(|key| used.get(**key).is_some_and(|v| !v.is_null())).is_some_and(|key| is_saved(key))
        };
        for assumption in assumptions.iter_mut().filter(|a| a.certainty == Certainty::Given) {
            if let Some(by) = assumption.why.specified_by().filter(|_| is_any_saved(assumption.what)) {
                *by = sidecar.clone();
            }
        }
        for note in notes.iter_mut() {
            let is_saved = match note {
                Note::MapSpecified { map, file, .. } => self
                    .bindings
                    .iter()
                    .any(|b| b.role() == *map && b.file().is_none_or(|own| own.path() == file)),
                Note::RowsFlipped { .. } => is_saved("flip-v"),
                Note::SpecularMedian { .. } => is_any_saved(What::Specular),
                _ => false,
            };
            if let Some(by) = note.specified_by().filter(|_| is_saved) {
                *by = sidecar.clone();
            }
        }
        notes.insert(0, Note::SidecarUsed { file: file.to_owned() });
    }
}

/// The place of the sidecar file of the material `path` alone.
fn own_place(path: &Path) -> PathBuf {
    if Sidecar::is_named(path) {
        return path.to_owned();
    }
    if path.is_dir() {
        return path.join(IN_FOLDER);
    }
    let name = if path.exists() { path.file_stem() } else { path.file_name() };
    let name = name.unwrap_or_default().to_string_lossy().into_owned();
    let is_end = |c: char| !path.exists() && !c.is_alphanumeric();
    path.with_file_name(format!("{}{BESIDE}", name.trim_end_matches(is_end)))
}

/// The place of the sidecar file of the folder that the file or prefix `path` is in.
fn common_place(path: &Path) -> Option<PathBuf> {
    (!Sidecar::is_named(path) && !path.is_dir()).then(|| path.with_file_name(IN_FOLDER))
}

/// Whether the file `path` is named after a map alone: its folder is then a material.
fn is_named_after_map(path: &Path) -> bool {
    let name = path.file_stem().unwrap_or_default().to_string_lossy();
    path.is_file() && Label::of(&name).is_some_and(|label| label.stem.is_empty() && !label.is_short())
}

fn keys() -> Vec<String> {
    ReadOptions::keys().into_iter().chain([MAPS.to_owned()]).collect()
}

/// The material that `path` stands for: for a sidecar file the file beside it, its prefix or its folder.
///
/// # Errors
/// [`Error::Unreadable`] without its folder, [`Error::NotAMaterial`] where several files could be meant.
pub(super) fn material_of(path: &Path) -> Result<PathBuf, Error> {
    if !Sidecar::is_named(path) {
        return Ok(path.to_owned());
    }
    let folder = folder_of(path);
    let file = path.file_name().unwrap_or_default().to_string_lossy();
    let Some(name) = file.strip_suffix(BESIDE) else { return Ok(folder.to_owned()) };
    let mut beside = Vec::new();
    for entry in fs::read_dir(folder).map_err(|source| Error::unreadable(path, source))? {
        let entry = entry.map_err(|source| Error::unreadable(path, source))?;
        let other = path.with_file_name(entry.file_name());
        let extension = other.extension().unwrap_or_default().to_string_lossy().to_lowercase();
        let opens = EXTENSIONS.contains(&extension.as_str()) && extension != "json";
        if opens && other.file_stem().is_some_and(|stem| stem.to_string_lossy() == name) {
            beside.push(other);
        }
    }
    beside.sort();
    match beside.as_slice() {
        [] => Ok(path.with_file_name(name)),
        [only] => Ok(only.clone()),
        several => Err(Error::NotAMaterial {
            path: path.to_owned(),
            expected: "one material beside it".to_owned(),
            found: several.iter().map(|p| p.display().to_string()).collect::<Vec<_>>().join(", "),
            remedy: "open one of them".to_owned(),
        }),
    }
}
