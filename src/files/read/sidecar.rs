//! What was said about a material, kept in a file beside it.

use std::fs;
use std::io::Write as _;
use std::path::{Path, PathBuf};

use serde_json::{Map, Value};

use super::EXTENSIONS;
use super::assumption::{AS_YOU_SAID, Assumption, Certainty, What};
use super::locate::binding::Binding;
use super::locate::names::Label;
use super::options::ReadOptions;
use crate::error::Error;
use crate::picture::export;
use crate::progress::Progress;

/// The name of the file in a folder.
const IN_FOLDER: &str = "svbrdf.json";
/// What comes after the name of a file, or a prefix, without its extension.
const BESIDE: &str = ".svbrdf.json";
/// The key of the maps that are named one by one.
const MAPS: &str = "maps";

/// What was said about a material: it holds whenever the material is opened and nothing else is said.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Kept {
    pub options: ReadOptions,
    pub bindings: Vec<Binding>,
}

impl Kept {
    /// Where it is kept for the material `path`: `svbrdf.json` in a folder, `NAME.svbrdf.json` beside a file `NAME.png`
    /// or the files of a prefix `NAME_`. Of a file whose name is that of a map, it is that of its folder if this is there
    /// and no other.
    pub fn place(path: &Path) -> PathBuf {
        if is_kept(path) {
            return path.to_owned();
        }
        if path.is_dir() {
            return path.join(IN_FOLDER);
        }
        if !path.exists() {
            let prefix = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
            let name = prefix.trim_end_matches(|c: char| !c.is_alphanumeric());
            return path.with_file_name(format!("{name}{BESIDE}"));
        }
        let name = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        let is_map = Label::of(&name).is_some_and(|label| label.stem.is_empty() && !label.is_short());
        let [own, common] = [name + BESIDE, IN_FOLDER.to_owned()].map(|name| path.with_file_name(name));
        if is_map && !own.exists() && common.exists() { common } else { own }
    }

    /// What is kept for the material `path`: nothing where there is no such file.
    ///
    /// # Errors
    /// [`Error::Unreadable`], [`Error::BadKept`].
    pub fn of(path: &Path) -> Result<Self, Error> {
        let place = Self::place(path);
        if !place.exists() && place != path {
            return Ok(Self::default());
        }
        let bytes = fs::read(&place).map_err(|source| Error::unreadable(&place, source))?;
        let bad = |problem: String| Error::BadKept { path: place.clone(), problem, keys: keys().join(", ") };
        let mut all: Map<String, Value> = serde_json::from_slice(&bytes).map_err(|e| bad(e.to_string()))?;
        let mut kept = Self::default();
        let maps = all.remove(MAPS).unwrap_or_else(|| Map::new().into());
        let maps =
            maps.as_object().ok_or_else(|| bad(format!("expected an object after {MAPS}, found {maps}")))?;
        for (map, file) in maps {
            let file = file
                .as_str()
                .ok_or_else(|| bad(format!("{map}: expected FILE or FILE:PART, found {file}")))?;
            let binding: Binding = format!("{map}={file}").parse().map_err(|e: Error| bad(e.to_string()))?;
            kept.bindings.push(binding.within(place.parent().unwrap_or(Path::new(""))));
        }
        // One by one, so that an error can say which.
        for (key, value) in &all {
            if !keys().contains(key) {
                return Err(bad(format!("unknown key `{key}`")));
            }
            let one = Value::from(Map::from_iter([(key.clone(), value.clone())]));
            serde_json::from_value::<ReadOptions>(one).map_err(|e| bad(format!("{key}: {e}")))?;
        }
        kept.options = serde_json::from_value(all.into()).map_err(|e| bad(e.to_string()))?;
        Ok(kept)
    }

    /// That no map is kept that is not there.
    pub(crate) fn check_maps(&self, path: &Path) -> Result<(), Error> {
        match self.bindings.iter().find(|binding| !binding.file().exists()) {
            Some(gone) => Err(Error::BadKept {
                path: Self::place(path),
                problem: format!("the {} map {} is not there", gone.role().name(), gone.file().display()),
                keys: keys().join(", "),
            }),
            None => Ok(()),
        }
    }

    /// With `options` and `bindings` before what is kept.
    #[must_use]
    pub fn under(self, options: &ReadOptions, bindings: &[Binding]) -> Self {
        let replaced = |kept: &Binding| bindings.iter().any(|new| new.role() == kept.role());
        let old = self.bindings.into_iter().filter(|kept| !replaced(kept));
        Self { options: options.over(self.options), bindings: old.chain(bindings.iter().cloned()).collect() }
    }

    /// Keeps it for the material `path`; returns where.
    ///
    /// # Errors
    /// [`Error::Unwritable`].
    pub fn write(&self, path: &Path) -> Result<PathBuf, Error> {
        let place = Self::place(path);
        let mut all = object(&self.options);
        all.retain(|_, value| !value.is_null());
        let folder = place.parent().unwrap_or(Path::new(""));
        let maps = self.bindings.iter().map(|binding| {
            let (map, file) = binding.said_within(folder);
            (map.to_owned(), Value::from(file))
        });
        let maps = Map::from_iter(maps);
        if !maps.is_empty() {
            all.insert(MAPS.to_owned(), maps.into());
        }
        let text = format!("{:#}\n", Value::from(all));
        export::replace(&place, &Progress::default(), |file| file.write_all(text.as_bytes()))?;
        Ok(place)
    }

    /// Says of the assumptions and notes that come from here, kept at `place`, that they do; `options` are those that
    /// the material was read with.
    pub(crate) fn credit(
        &self,
        place: &Path,
        options: &ReadOptions,
        assumptions: &mut [Assumption],
        notes: &mut Vec<String>,
    ) {
        let name = place.file_name().unwrap_or_default().to_string_lossy();
        let says = format!("as {name} says");
        let (kept, used) = (object(&self.options.with_preset()), object(&options.with_preset()));
        let is_kept =
            |key: &str| kept.get(key).is_some_and(|value| !value.is_null() && used.get(key) == Some(value));
        for assumption in assumptions.iter_mut().filter(|a| a.certainty == Certainty::Given) {
            let mut keys = keys_of(assumption.what).iter();
            if keys.find(|key| used.get(**key).is_some_and(|v| !v.is_null())).is_some_and(|key| is_kept(key))
            {
                assumption.why = assumption.why.replacen(AS_YOU_SAID, &says, 1);
            }
        }
        for note in notes.iter_mut() {
            let is_of_map = |b: &Binding| note.starts_with(&b.note());
            if self.bindings.iter().any(is_of_map) || (is_kept("flip-v") && note.starts_with("Row 0")) {
                *note = note.replacen(AS_YOU_SAID, &says, 1);
            }
        }
        notes.insert(
            0,
            format!("{} says how the material is read, where nothing else does.", place.display()),
        );
    }
}

/// The keys that say what an assumption says, the plainest first.
fn keys_of(what: What) -> &'static [&'static str] {
    match what {
        What::Layout => &["order", "grid"],
        What::Workflow => &["workflow"],
        What::Albedo => &["albedo"],
        What::Specular => &["specular-albedo", "albedo"],
        What::NormalY => &["normal-y", "preset"],
        What::NormalCode => &["normal-code"],
        What::Roughness => &["roughness"],
        What::Energy => &["energy"],
        What::Missing => &["dielectric-f0"],
        What::Size | What::Values => &[],
    }
}

fn object(options: &ReadOptions) -> Map<String, Value> {
    match serde_json::to_value(options) {
        Ok(Value::Object(all)) => all,
        _ => Map::new(),
    }
}

fn keys() -> Vec<String> {
    let options = object(&ReadOptions::AUTO);
    options.into_iter().map(|(key, _)| key).chain([MAPS.to_owned()]).collect()
}

/// Whether `path` is by its name not a material, but what is kept with one.
fn is_kept(path: &Path) -> bool {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    name == IN_FOLDER || name.ends_with(BESIDE)
}

/// The material that is meant by `path`: that of a kept file is the file beside it, its prefix or its folder.
///
/// # Errors
/// [`Error::Unreadable`] without its folder, [`Error::NotAMaterial`] where several files could be meant.
pub fn material_of(path: &Path) -> Result<PathBuf, Error> {
    if !is_kept(path) {
        return Ok(path.to_owned());
    }
    let folder = path.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."));
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
