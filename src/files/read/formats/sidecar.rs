//! The sidecar file: how a material is read, saved beside it.

use std::io::Write as _;
use std::path::{Path, PathBuf};

use serde_json::{Map, Value, json};

use svbrdf_core::error::Error as CoreError;
use svbrdf_core::progress::Progress;
use svbrdf_core::text::of_json;

use super::binding::Binding;
use crate::disk::open::NamedFile;
use crate::disk::{atomic, own};
use crate::error::Error;
use crate::read::options::ReadOptions;

/// The name of the file in a folder.
const IN_FOLDER: &str = "svbrdf.json";
/// The key of the maps that are specified one by one.
const MAPS: &str = "maps";

/// How a material is read unless other options are specified.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Sidecar {
    /// Where it was loaded from; `None` where there is no such file.
    pub(crate) file: Option<PathBuf>,
    pub options: ReadOptions,
    pub bindings: Vec<Binding>,
}

impl Sidecar {
    /// The sidecar file of the material `path` alone: `svbrdf.json` in a folder, `NAME.svbrdf.json` beside a file `NAME.png` or the
    /// files of a prefix `NAME_`.
    pub fn path_for(path: &Path) -> PathBuf {
        if path.is_dir() {
            return path.join(IN_FOLDER);
        }
        let name = if path.exists() { path.file_stem() } else { path.file_name() };
        let name = name.unwrap_or_default().to_string_lossy().into_owned();
        let is_end = |c: char| !path.exists() && !c.is_alphanumeric();
        path.with_file_name(format!("{}.{IN_FOLDER}", name.trim_end_matches(is_end)))
    }

    /// Reads the sidecar file of the material `path`, or else that of the folder it is in, whose maps are those of another
    /// material; the default where there is none.
    ///
    /// # Errors
    /// [`Error::Unreadable`], [`Error::BadSidecar`], [`Error::Outside`].
    pub fn load(path: &Path) -> Result<Self, Error> {
        let own = Self::path_for(path);
        let place = if own.exists() { own.clone() } else { own.with_file_name(IN_FOLDER) };
        if !place.exists() {
            return Ok(Self::default());
        }
        let text = NamedFile::by_file(&place, path).text()?;
        let keys = ReadOptions::keys();
        let bad = |problem: String| {
            let keys = format!("{}, {MAPS}", keys.join(", "));
            Error::BadSidecar { path: place.clone(), problem, keys }
        };
        let mut all: Map<String, Value> = serde_json::from_str(&text).map_err(|e| bad(of_json(&e)))?;
        let maps = all.remove(MAPS).unwrap_or_else(|| json!({}));
        let maps: Map<String, Value> =
            serde_json::from_value(maps).map_err(|e| bad(format!("{MAPS}: {e}")))?;
        let mut bindings = Vec::new();
        for (map, file) in maps.iter().filter(|_| place == own) {
            let file = file.as_str().ok_or_else(|| bad(format!("{map}: expected FILE or FILE:PART")))?;
            let binding: Result<Binding, CoreError> = format!("{map}={file}").parse();
            bindings.push(binding.map_err(|e| bad(e.to_string()))?.named_by(&place)?);
        }
        // One by one, so that an error can name the key.
        for (key, value) in &all {
            if !keys.contains(key) {
                return Err(bad(format!("unknown key `{key}`")));
            }
            serde_json::from_value::<ReadOptions>(json!({ key: value }))
                .map_err(|e| bad(format!("{key}: {e}")))?;
        }
        let options = serde_json::from_value(all.into()).map_err(|e| bad(of_json(&e)))?;
        Ok(Self { file: Some(place), options, bindings })
    }

    /// `options` and `bindings`, and its own where these specify nothing.
    #[must_use]
    pub fn overridden_by(self, options: &ReadOptions, bindings: &[Binding]) -> Self {
        let is_left = |old: &Binding| bindings.iter().all(|new| new.role() != old.role());
        let old = self.bindings.into_iter().filter(is_left);
        let bindings = old.chain(bindings.iter().cloned()).collect();
        Self { options: options.over(self.options), bindings, file: self.file }
    }

    /// Writes the sidecar file of the material `path`; returns its path.
    ///
    /// # Errors
    /// [`Error::Unwritable`], also where it is a link; [`Cancelled`](Error::is_cancelled).
    pub fn save(&self, path: &Path, progress: &Progress) -> Result<PathBuf, Error> {
        let place = Self::path_for(path);
        own::check(&place)?;
        let mut all = self.options.object();
        all.retain(|_, value| !value.is_null());
        if !self.bindings.is_empty() {
            let folder = place.parent().unwrap_or(Path::new(""));
            let maps = self.bindings.iter().map(|binding| binding.relative_to(folder));
            let maps = maps.map(|(map, file)| (map.to_owned(), Value::from(file)));
            all.insert(MAPS.to_owned(), Map::from_iter(maps).into());
        }
        let text = format!("{:#}\n", Value::from(all));
        atomic::update(&place, progress, |file| file.write_all(text.as_bytes()))?;
        Ok(place)
    }
}
