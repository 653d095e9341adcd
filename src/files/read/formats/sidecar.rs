//! Bindings: maps that are specified one by one; and the sidecar file: they and the options of a material, saved beside it.

use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::str::FromStr;

use serde_json::{Map, Value, json};

use svbrdf_core::error::Error as CoreError;
use svbrdf_core::progress::Progress;
use svbrdf_core::text::of_json;

use super::picture;
use crate::disk::open::NamedFile;
use crate::disk::paths::{absolute, relative};
use crate::disk::{atomic, own};
use crate::error::Error;
use crate::read::decode::{self, Layer};
use crate::read::names::listing;
use crate::read::options::{ReadOptions, Role};
use crate::read::record::Subject;
use crate::read::stored::StoredMap;

/// `normal=FILE`, `roughness=FILE:g` for one channel or layer of the file, or `roughness=0.5` for a constant.
#[derive(Clone, Debug, PartialEq)]
pub struct Binding {
    role: Role,
    source: Source,
}

#[derive(Clone, Debug, PartialEq)]
enum Source {
    /// The part is r, g, b, a, or the name of a layer.
    File { file: NamedFile, part: Option<String> },
    /// The value, or red, green and blue.
    Constant(Vec<f32>),
}

const ROLES: [(&str, Role); 6] = [
    ("normal", Role::Normal),
    ("diffuse", Role::Diffuse),
    ("base", Role::Base),
    ("specular", Role::Specular),
    ("roughness", Role::Roughness),
    ("metallic", Role::Metallic),
];

impl FromStr for Binding {
    type Err = CoreError;

    fn from_str(text: &str) -> Result<Self, CoreError> {
        let (name, file) = text.split_once('=').unwrap_or((text, ""));
        let role = ROLES.into_iter().find(|(known, _)| *known == name).map(|(_, role)| role);
        let (Some(role), false) = (role, file.is_empty()) else {
            return Err(CoreError::unknown_name(
                "map",
                if role.is_some() { text } else { name },
                format!(
                    "{}, each as in normal=FILE, roughness=FILE:g or roughness=0.5",
                    ROLES.map(|(n, _)| n).join(", ")
                ),
            ));
        };
        if let Some(values) = constant(file).filter(|values| values.len() == 1 || role.is_colour()) {
            return Ok(Self { role, source: Source::Constant(values) });
        }
        if file.split(',').all(|number| number.trim().parse::<f32>().is_ok()) && !Path::new(file).exists() {
            let known = "a number from 0 to 1; diffuse, base and specular also three: 0.2,0.1,0.1";
            return Err(CoreError::unknown_name("constant of a map", file, known));
        }
        let (file, part) = match file.rsplit_once(':') {
            Some((file, part)) if !file.is_empty() && !part.contains(['/', '\\']) => {
                (file, Some(part.to_owned()))
            }
            _ => (file, None),
        };
        let (file, part) = (NamedFile::by_user(file), part.filter(|part| part != "rgb"));
        Ok(Self { role, source: Source::File { file, part } })
    }
}

/// Numbers of [0, 1]: one, or three for red, green and blue.
fn constant(text: &str) -> Option<Vec<f32>> {
    let number = |text: &str| text.trim().parse().ok().filter(|value| (0.0..=1.0).contains(value));
    let values: Vec<f32> = text.split(',').map(number).collect::<Option<_>>()?;
    matches!(values.len(), 1 | 3).then_some(values)
}

impl Binding {
    pub(crate) fn role(&self) -> Role {
        self.role
    }

    /// The file; `None` of a constant.
    pub(crate) fn file(&self) -> Option<&NamedFile> {
        match &self.source {
            Source::File { file, .. } => Some(file),
            Source::Constant(_) => None,
        }
    }

    /// Reads its map.
    ///
    /// # Errors
    /// [`Error::BadImage`] where the file has no such part; [`Error::Unreadable`].
    pub(super) fn read(&self) -> Result<(Role, StoredMap), Error> {
        let (role, what) = (self.role, Subject::Map(self.role));
        let (named, part) = match &self.source {
            Source::File { file, part } => (file, part.clone()),
            Source::Constant(values) => return Ok((role, StoredMap::specified(values))),
        };
        let file = named.path().to_owned();
        let Some(part) = part else {
            let raster = decode::one(named, what)?.0.raster;
            return Ok((role, StoredMap { raster, file, part: String::new() }));
        };
        let mut all = decode::whole(named, what)?.layers;
        let channel = ["r", "g", "b", "a"].iter().position(|letter| *letter == part);
        let raster = match (all.iter().position(|layer| layer.name == part), channel, all.as_slice()) {
            (Some(place), ..) => Some(all.swap_remove(place).raster),
            (None, Some(3), [Layer { raster, .. }]) => raster.alpha.clone().map(|alpha| raster.of(alpha)),
            (None, Some(channel), [Layer { raster, .. }]) => {
                raster.channels.get(channel).map(|plane| raster.of(plane.clone()))
            }
            _ => None,
        };
        let names: Vec<_> = all.iter().map(picture::name).collect();
        let raster = raster.ok_or_else(|| Error::BadImage {
            path: file.clone(),
            problem: format!("{what}: expected the part {part}, found {}", listing(&names)),
            remedy: "name a channel (r, g, b, a) that it has, or one of its layers".to_owned(),
        })?;
        Ok((role, StoredMap { raster, file, part }))
    }

    /// The same as the sidecar file `sidecar` has it: the path of the file is relative to its folder.
    ///
    /// # Errors
    /// [`Error::Outside`].
    pub(crate) fn named_by(mut self, sidecar: &Path) -> Result<Self, Error> {
        if let Source::File { file, .. } = &mut self.source {
            *file = NamedFile::within(file.path(), sidecar);
            file.check()?;
        }
        Ok(self)
    }

    /// The name of the map, and `FILE` or `FILE:PART` relative to `folder`, or the constant.
    pub(crate) fn relative_to(&self, folder: &Path) -> (&'static str, String) {
        let name = ROLES.iter().find(|(_, role)| *role == self.role).map_or("", |(name, _)| name);
        let text = match &self.source {
            Source::Constant(values) => values.iter().map(f32::to_string).collect::<Vec<_>>().join(","),
            Source::File { file, part } => {
                let part = part.as_ref().map(|part| format!(":{part}")).unwrap_or_default();
                format!("{}{part}", relative(&absolute(file.path()), &absolute(folder)).display())
            }
        };
        (name, text)
    }
}

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
