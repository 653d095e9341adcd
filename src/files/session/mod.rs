//! The session file: a comparison that another person can open, with everything that it takes.

pub mod dataset;
mod picture;
pub mod window;

use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};
use serde_json::Value;

use svbrdf_core::error::Error as CoreError;
use svbrdf_core::model::scene::Scene;
use svbrdf_core::text::of_json;

use crate::convention;
use crate::disk::inputs;
use crate::disk::open::NamedFile;
use crate::disk::paths::{absolute, is_outside, relative};
use crate::error::Error;
use crate::photograph::SessionPhotograph;
use crate::read::MaterialPath;
use crate::source::{MaterialSource, Place};
use dataset::SessionDataset;
pub(crate) use picture::KEYWORD;
use window::SessionWindow;

/// What the names of session files end with.
const ENDING: &str = ".svbrdf-session.json";
/// The version that is written, and the latest that is read.
const VERSION: u32 = 1;

/// A comparison: materials, how they are read and rendered, and what a window adds.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub struct Session {
    #[serde(rename = "svbrdf-session")]
    version: u32,
    /// The ground truth first, then the predictions.
    pub materials: Vec<MaterialSource>,
    pub scene: Scene,
    /// The name of the convention, or the text of one of the user's own. A file may also have the path of such a text.
    pub convention: String,
    /// Exposure in stops.
    #[serde(default)]
    pub exposure: f32,
    /// Which texels are compared, where not all are: `alpha`, `alpha-else-black`, or a picture, in whose path `{}` stands for the name of
    /// the ground truth.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub mask: Option<PathBuf>,
    /// The photograph that renderings are compared with.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub photograph: Option<SessionPhotograph>,
    /// The data set whose material the comparison is of.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub dataset: Option<SessionDataset>,
    /// Display and loss settings of the window.
    #[serde(default, skip_serializing_if = "SessionWindow::is_empty")]
    pub window: SessionWindow,
    /// Of a picture: the files of its materials, each with its SHA-256.
    #[serde(rename = "sha256", default, skip_serializing_if = "Vec::is_empty")]
    digests: Vec<(PathBuf, String)>,
}

impl Session {
    /// Whether `path` is named like a session file.
    pub fn is_named(path: &Path) -> bool {
        path.file_name().is_some_and(|name| name.to_string_lossy().ends_with(ENDING))
    }

    /// Whether these paths give a session: a session file is among them, or a picture with a session stands alone.
    pub fn is_among(paths: &[impl AsRef<Path>]) -> bool {
        let is_named = |path: &Path| Self::is_named(path);
        match paths {
            [path] => is_named(path.as_ref()) || picture::has(path.as_ref()),
            _ => paths.iter().any(|path| is_named(path.as_ref())),
        }
    }

    /// A session without anything of a window.
    pub fn new(materials: Vec<MaterialSource>, scene: Scene, convention: String, exposure: f32) -> Self {
        let (photograph, window) = (None, SessionWindow::default());
        let (version, mask, dataset, digests) = (VERSION, None, None, Vec::new());
        Self { version, materials, scene, convention, exposure, mask, photograph, dataset, window, digests }
    }

    /// Reads a session file, or the session of a picture; its paths become those from here.
    ///
    /// # Errors
    /// [`Error::Unreadable`], [`Error::BadSession`].
    pub fn read(path: &Path) -> Result<Self, Error> {
        let of_picture = picture::text(path)?;
        let text = of_picture.map_or_else(|| NamedFile::by_user(path).text(), Ok)?;
        inputs::protect(path);
        let bad = |problem: String| Error::BadSession { path: path.to_owned(), problem };
        let value: Value = serde_json::from_str(&text).map_err(|e| bad(of_json(&e)))?;
        // Before its fields are judged: a newer version may have others.
        let version = value.get("svbrdf-session").and_then(Value::as_u64).unwrap_or(0);
        if version > u64::from(VERSION) {
            return Err(bad(format!(
                "expected version {VERSION}, found version {version} of a newer program: update this one"
            )));
        }
        let materials = value.get("materials").and_then(Value::as_array);
        let is_placed = |one: &Value| one.get("path").is_some() != one.get("built-in").is_some();
        if !materials.is_none_or(|all| all.iter().all(is_placed)) {
            return Err(bad("expected a path or the number of a built-in material".to_owned()));
        }
        let mut session: Self = serde_json::from_str(&text).map_err(|e| bad(of_json(&e)))?;
        session.scene.check().map_err(|problem| bad(format!("the scene cannot be rendered, {problem}")))?;
        if session.materials.is_empty() {
            return Err(bad("expected at least one material, found none".to_owned()));
        }
        for name in session.paths_mut() {
            *name = named(name, path)?;
        }
        if convention::is_file(Path::new(&session.convention)) {
            session.convention = named(Path::new(&session.convention), path)?.display().to_string();
        }
        Ok(session)
    }

    /// Every path but that of a convention.
    fn paths_mut(&mut self) -> impl Iterator<Item = &mut PathBuf> {
        let materials = self.materials.iter_mut().filter_map(|material| match &mut material.place {
            Place::Path(path) => Some(path),
            Place::BuiltIn(_) => None,
        });
        let photograph = self.photograph.iter_mut().map(|photograph| &mut photograph.path);
        let mask = self
            .mask
            .iter_mut()
            .filter(|mask| !["alpha", "alpha-else-black"].map(Path::new).contains(&mask.as_path()));
        materials
            .chain(photograph)
            .chain(mask)
            .chain(self.digests.iter_mut().map(|(path, _)| path))
            .chain(self.dataset.iter_mut().flat_map(SessionDataset::paths_mut))
    }

    /// The files of a session that was read from `path` which lie outside of its folder.
    pub fn outside(&self, path: &Path) -> Vec<PathBuf> {
        let folder = path.parent().unwrap_or(Path::new(""));
        let convention = Some(PathBuf::from(&self.convention)).filter(|path| convention::is_file(path));
        let mut session = Self { digests: Vec::new(), ..self.clone() };
        let all = session.paths_mut().map(|path| path.clone()).chain(convention);
        all.filter(|file| is_outside(file, folder)).collect()
    }

    /// The text of the session file `path`: the paths of materials are relative to its folder.
    ///
    /// # Errors
    /// [`CoreError::UnknownName`] where the file is not named like a session file, [`Error::Internal`].
    pub fn text(&self, path: &Path) -> Result<String, Error> {
        if !Self::is_named(path) {
            let (found, known) = (path.display().to_string(), format!("NAME{ENDING}"));
            return Err(CoreError::unknown_name("name of a session file", found, known).into());
        }
        Ok(format!("{:#}\n", self.json(path)?))
    }

    /// The session as (keyword, text) in the metadata of the picture `path`, with the digests of the files of its materials.
    ///
    /// # Errors
    /// [`Error::Internal`].
    pub fn entry(&self, path: &Path) -> Result<(&'static str, String), Error> {
        let files = |one: &MaterialSource| {
            let found = MaterialPath::new(one.place.path()?, &one.options).dependencies();
            found.ok().map(|found| found.files)
        };
        let digests = self.materials.iter().filter_map(files).flatten().collect();
        Ok((picture::KEYWORD, picture::written(&Self { digests, ..self.clone() }.json(path)?)))
    }

    /// The files of the materials that have changed since the picture was saved which the session is from.
    pub fn changed(&self) -> Vec<&Path> {
        let has_changed = |(path, saved): &&(PathBuf, String)| {
            NamedFile::by_user(path).digest().is_ok_and(|found| found != *saved)
        };
        self.digests.iter().filter(has_changed).map(|(path, _)| path.as_path()).collect()
    }

    /// What is written to the file `path`.
    fn json(&self, path: &Path) -> Result<Value, Error> {
        let mut session = self.clone();
        let folder = absolute(path.parent().unwrap_or(Path::new("")));
        for path in session.paths_mut() {
            *path = relative(&absolute(path), &folder);
        }
        let failed = |e: serde_json::Error| Error::Internal(format!("a session cannot be written: {e}"));
        let mut value = serde_json::to_value(&session).map_err(failed)?;
        for material in value["materials"].as_array_mut().into_iter().flatten() {
            if let Some(read) = material["read"].as_object_mut() {
                read.retain(|_, option| !option.is_null());
            }
        }
        Ok(value)
    }
}

/// The path that `session` calls `name`: of a file, a folder or a prefix, and of nothing that waits or has no end.
fn named(name: &Path, session: &Path) -> Result<PathBuf, Error> {
    let file = NamedFile::within(name, session);
    file.check()?;
    if file.path().metadata().is_ok_and(|found| !found.is_file() && !found.is_dir()) {
        file.open()?;
    }
    Ok(file.path().to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::read::{Albedo, ReadOptions};
    use std::fs;
    use svbrdf_core::model::scene::Kind;

    fn session(paths: &[PathBuf]) -> Session {
        let read = ReadOptions { albedo: Some(Albedo::Srgb), ..ReadOptions::AUTO };
        let material =
            |path: &PathBuf| MaterialSource { fit: true, ..MaterialSource::path(path.clone(), read) };
        let scene = Scene { kind: Kind::Distant, view: [0.1, 0.2, 1.0], light: [0.3, 0.1, 0.7] };
        Session::new(paths.iter().map(material).collect(), scene, "guided-2020".to_owned(), -0.5)
    }

    fn photograph(path: PathBuf) -> SessionPhotograph {
        SessionPhotograph { path, transfer: Some(Albedo::Srgb), falloff: true }
    }

    #[test]
    fn a_session_that_moves_with_its_files_finds_them() {
        let folder = tempfile::tempdir().unwrap();
        let [here, there] = ["here", "there"].map(|name| folder.path().join(name));
        fs::create_dir_all(here.join("runs")).unwrap();
        let paths = [here.join("maps/gt.png"), here.join("p.png")];
        let file = here.join("runs/a.svbrdf-session.json");
        let saved = session(&paths);
        let mut saved = saved;
        saved.photograph = Some(photograph(here.join("photos/a.jpg")));
        let text = saved.text(&file).unwrap();
        assert!(text.contains("\"../maps/gt.png\"") && text.contains("\"../p.png\""), "{text}");
        assert!(text.contains("\"../photos/a.jpg\""), "{text}");
        assert!(!text.contains("null") && text.contains("srgb"), "{text}");
        fs::write(&file, text).unwrap();
        fs::rename(&here, &there).unwrap();
        let read = Session::read(&there.join("runs/a.svbrdf-session.json")).unwrap();
        let found: Vec<_> = read.materials.iter().map(|m| absolute(m.location())).collect();
        assert_eq!(found, [there.join("maps/gt.png"), there.join("p.png")]);
        let moved = [there.join("runs/../maps/gt.png"), there.join("runs/../p.png")];
        let photographed =
            Session { photograph: Some(photograph(there.join("runs/../photos/a.jpg"))), ..session(&moved) };
        assert_eq!(read, photographed);
    }

    #[test]
    fn what_is_no_session_is_refused_with_its_reason() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.svbrdf-session.json");
        let good = session(&["gt.png".into()]).text(&path).unwrap();
        let cases = [
            (good.replace("\"svbrdf-session\": 1", "\"svbrdf-session\": 2"), "newer program"),
            (good.replace("0.7", "-0.7"), "cannot be rendered"),
            (good.replace("\"path\"", "\"way\""), "expected a path"),
            (good.replace("\"materials\"", "\"things\""), "materials"),
            ("[".to_owned(), "the text ends within a list"),
            (r#"{"svbrdf-session": 9, "materials": 3}"#.to_owned(), "newer program"),
            (good.replacen('{', r#"{"window": {"loss": {"ask": "Acuracy"}},"#, 1), "window.loss.ask"),
        ];
        for (text, reason) in cases {
            assert_ne!(text, good);
            fs::write(&path, text).unwrap();
            let error = Session::read(&path).unwrap_err().to_string();
            assert!(error.contains(reason), "{error}");
        }
        assert!(session(&[]).text(Path::new("a.json")).is_err());
    }
}
