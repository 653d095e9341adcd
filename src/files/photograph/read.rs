//! Reading of the description of a capture: a file, or one in its folder.

use std::collections::HashSet;
use std::fs;
use std::path::{Path, PathBuf};

use serde_json::Value;

use svbrdf_core::model::scene::{Kind, Scene};
use svbrdf_core::text::of_json;

use super::capture::{Capture, CapturedPhotograph, is_json};
use super::listed::ListedCapture;
use super::materialgan::{Calibration, LightPower, POSITIONS, TEXTS};
use crate::disk::inputs;
use crate::disk::open::NamedFile;
use crate::error::Error;
use crate::read::{PhotographOptions, Transfer};

/// The name of the project's own description.
const OWN: &str = "capture.json";

/// Most photographs of a capture.
const MOST: usize = 10_000;

impl Capture {
    /// Reads the description of the capture in the folder `path`, or that file itself. The photographs are not read yet.
    ///
    /// In a folder, it is `capture.json`, or else the only one of the JSON files of MaterialGAN, of which several may list the same
    /// photographs, or else its text files.
    ///
    /// # Errors
    /// [`Error::BadCapture`], [`Error::Unreadable`]; [`Error::Outside`] for a photograph that is named by an absolute path.
    pub fn read(path: &Path) -> Result<Self, Error> {
        let capture = if path.is_dir() { in_folder(path)? } else { in_file(path)? };
        capture.photographs.iter().try_for_each(|photograph| photograph.file.check())?;
        Ok(Self { path: path.to_owned(), ..capture })
    }

    /// The capture that the text of the file at `path` describes.
    fn parse(path: &Path, text: &str) -> Result<Self, Error> {
        inputs::protect(path);
        let bad = |problem| Error::BadCapture { path: path.to_owned(), problem };
        let value: Value = serde_json::from_str(text).map_err(|e| bad(of_json(&e)))?;
        let capture = match value.get(POSITIONS).is_some() {
            true => serde_json::from_str(text)
                .map_err(|e| of_json(&e))
                .and_then(|calibration| Self::of_materialgan(path, &calibration)),
            false => serde_json::from_str(text)
                .map_err(|e| of_json(&e))
                .and_then(|listed| Self::of_list(path, &listed)),
        };
        let capture = capture.map_err(bad)?;
        capture.check().map_err(bad)?;
        Ok(capture)
    }

    fn of_list(path: &Path, listed: &ListedCapture) -> Result<Self, String> {
        let photographs = listed.photographs(path)?;
        Ok(Self::listed_by(path, photographs, listed.falloff, None))
    }

    /// Its renderer stores the power 1 / 2.2 of radiance, which falls off with the distance of the light.
    fn of_materialgan(path: &Path, calibration: &Calibration) -> Result<Self, String> {
        let folder = calibration
            .target_dir
            .as_ref()
            .ok_or("its target_dir, the folder of the photographs, is missing")?;
        let scenes = calibration.scenes()?;
        let power = calibration.power()?;
        let light_colour = power.filter(|power| !power.is_white()).map(|power| power.colour);
        let options = PhotographOptions { transfer: Some(Transfer::Gamma22), clip: None, light_colour };
        let photograph = |(number, scene): (usize, Scene)| {
            let name = format!("{number:02}.png");
            let file = NamedFile::within(folder.join(&name), path);
            CapturedPhotograph { name, file, scene, corners: None, options }
        };
        let photographs = calibration.numbers().into_iter().zip(scenes).map(photograph).collect();
        Ok(Self { is_materialgan: true, ..Self::listed_by(path, photographs, true, power) })
    }

    fn listed_by(
        file: &Path,
        photographs: Vec<CapturedPhotograph>,
        falloff: bool,
        power: Option<LightPower>,
    ) -> Self {
        let (path, file) = (file.to_owned(), Some(file.to_owned()));
        Self { path, file, is_materialgan: false, photographs, falloff, power }
    }

    fn check(&self) -> Result<(), String> {
        let count = self.photographs.len();
        if !(1..=MOST).contains(&count) {
            return Err(format!("expected 1 to {MOST} photographs, found {count}"));
        }
        let mut names = HashSet::new();
        for (i, one) in self.photographs.iter().enumerate() {
            one.scene.check().map_err(|problem| format!("scene {i}: {problem}"))?;
            if self.falloff && one.scene.kind == Kind::Distant {
                return Err(format!("scene {i}: expected a near one, since a distant light has no falloff"));
            }
            if !names.insert(&one.name) {
                return Err(format!("it lists {} twice", one.name));
            }
        }
        Ok(())
    }
}

/// The capture that the file at `path` describes: JSON, or one of the text files.
fn in_file(path: &Path) -> Result<Capture, Error> {
    match path.parent() {
        Some(folder) if path.ends_with(TEXTS[0]) => of_texts(folder),
        _ => Capture::parse(path, &NamedFile::by_user(path).text()?),
    }
}

/// The capture of the text files in `folder`.
fn of_texts(folder: &Path) -> Result<Capture, Error> {
    let path = folder.join(TEXTS[0]);
    let bad = |problem| Error::BadCapture { path: path.clone(), problem };
    let [cameras, lights, size, power] =
        TEXTS.map(|name| NamedFile::by_file(folder.join(name), folder).text());
    let (cameras, lights, size, power) = (cameras?, lights?, size?, power?);
    let calibration = Calibration::of_texts([&cameras, &lights, &size, &power]).map_err(bad)?;
    let capture = Capture::of_materialgan(&path, &calibration).map_err(bad)?;
    capture.check().map_err(bad)?;
    Ok(capture)
}

/// The capture in `folder`.
fn in_folder(folder: &Path) -> Result<Capture, Error> {
    let own = folder.join(OWN);
    if own.exists() {
        return Capture::parse(&own, &NamedFile::by_file(&own, folder).text()?);
    }
    let mut found: Vec<(PathBuf, Calibration, String)> = Vec::new();
    let mut broken = None;
    for path in json_files(folder)? {
        let text = NamedFile::by_file(&path, folder).text()?;
        match serde_json::from_str::<Calibration>(&text) {
            Ok(calibration) if found.iter().any(|(_, other, _)| *other == calibration) => {}
            Ok(calibration) => found.push((path, calibration, text)),
            Err(_) if Calibration::is_meant(&text) => broken = broken.or(Some((path, text))),
            Err(_) => {}
        }
    }
    let problem = match found.as_slice() {
        [(path, _, text)] => return Capture::parse(path, text),
        [] if folder.join(TEXTS[0]).is_file() => return of_texts(folder),
        [] => match broken {
            Some((path, text)) => return Capture::parse(&path, &text),
            None => "it holds no list of photographs".to_owned(),
        },
        several => {
            let name = |(path, ..): &(PathBuf, Calibration, String)| {
                path.file_name().unwrap_or_default().to_string_lossy().into_owned()
            };
            let names: Vec<_> = several.iter().map(name).collect();
            format!("found several that differ: {}; name one of these files", names.join(", "))
        }
    };
    Err(Error::BadCapture { path: folder.to_owned(), problem })
}

/// The JSON files of a folder, by name.
fn json_files(folder: &Path) -> Result<Vec<PathBuf>, Error> {
    let unreadable = |source| Error::unreadable(folder, source);
    let entries = fs::read_dir(folder).map_err(unreadable)?;
    let paths = entries.map(|entry| entry.map(|entry| entry.path())).collect::<Result<Vec<_>, _>>();
    let mut paths = paths.map_err(unreadable)?;
    paths.retain(|path| is_json(path) && path.is_file());
    paths.sort();
    Ok(paths)
}
