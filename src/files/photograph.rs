//! Photographs of a material with their lights and views, to be read: a [`Capture`], which may be of one.
//!
//! A capture is a folder with a `capture.json` (`docs/photographs.md`) or the `render.json` of MaterialGAN, such a file, or a single
//! photograph. Photographs are rectified: the material fills them.

use std::collections::HashSet;
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use svbrdf_core::model::scene::{Kind, Scene};
use svbrdf_core::text::{line, of_json};

use crate::disk::inputs;
use crate::disk::open::NamedFile;
use crate::error::Error;
use crate::read::Albedo;

/// The files that list the photographs of a folder: the project's own, and that of MaterialGAN.
const LISTS: [&str; 2] = ["capture.json", "render.json"];

/// Most photographs of a capture.
const MOST: usize = 10_000;

/// The photographs of a material, with their lights and views.
#[derive(Clone, Debug, PartialEq)]
pub struct Capture {
    /// The path that a user gave: of a photograph, a folder, or the file that lists the photographs.
    pub path: PathBuf,
    /// At least one; their names differ.
    pub photographs: Vec<CapturedPhotograph>,
    /// Whether the falloff of the light is divided out of the photographs.
    pub falloff: bool,
}

/// A photograph of a capture, to be read.
#[derive(Clone, Debug, PartialEq)]
pub struct CapturedPhotograph {
    /// The name of its file in the capture.
    pub name: String,
    pub file: NamedFile,
    pub scene: Scene,
    /// `None`: by the file.
    pub transfer: Option<Albedo>,
}

/// A photograph and how it is used, as a session stores it. It is taken in the scene of the session.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub struct SessionPhotograph {
    /// Its file. In a file, it is relative to the folder of the file.
    pub path: PathBuf,
    /// `None`: by the file.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub transfer: Option<Albedo>,
    /// Whether the falloff of the light is divided out.
    #[serde(default)]
    pub falloff: bool,
}

impl Capture {
    /// Whether a path may be that of several photographs: a folder, or JSON.
    pub fn is_named(path: &Path) -> bool {
        path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("json")) || path.is_dir()
    }

    /// One photograph, taken in this scene.
    pub fn of_one(photograph: SessionPhotograph, scene: Scene) -> Self {
        let SessionPhotograph { path, transfer, falloff } = photograph;
        let (name, file) = (path.display().to_string(), NamedFile::by_user(&path));
        Self { path, photographs: vec![CapturedPhotograph { name, file, scene, transfer }], falloff }
    }

    /// Reads the list of the photographs in the folder `path`, or that file itself. The photographs are not read yet.
    ///
    /// # Errors
    /// [`Error::BadCapture`], [`Error::Unreadable`]; [`Error::Outside`] for a photograph that is named by an absolute path.
    pub fn read(path: &Path) -> Result<Self, Error> {
        let bad = |file: &Path, problem| Error::BadCapture { path: file.to_owned(), problem };
        let list = match path.is_dir() {
            true => LISTS.map(|name| path.join(name)).into_iter().find(|file| file.is_file()).map_or_else(
                || Err(bad(path, "it has neither of these files".to_owned())),
                |file| Ok(NamedFile::by_file(file, path)),
            )?,
            false => NamedFile::by_user(path),
        };
        let (text, file) = (list.text()?, list.path());
        inputs::protect(file);
        let parse = || {
            let photographs = match serde_json::from_str::<Calibration>(&text) {
                Ok(calibration) => calibration.photographs(file)?,
                Err(problem) if text.contains(Calibration::KEY) => return Err(of_json(&problem)),
                Err(_) => {
                    let listed: ListedCapture = serde_json::from_str(&text).map_err(|e| of_json(&e))?;
                    return listed.capture(path, file);
                }
            };
            Ok(Self { path: path.to_owned(), photographs, falloff: true })
        };
        let capture = parse().and_then(Self::checked).map_err(|problem| bad(file, problem))?;
        capture.photographs.iter().try_for_each(|photograph| photograph.file.check())?;
        Ok(capture)
    }

    fn checked(self) -> Result<Self, String> {
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
        Ok(self)
    }

    /// A note about each photograph outside of the folder of the file that lists it.
    pub fn outside(&self) -> Vec<String> {
        let outside = self.photographs.iter().filter_map(|one| Some((one.file.path(), one.file.outside()?)));
        let note = |(file, by): (&Path, &Path)| {
            format!("{} lies outside of the folder of {}, which names it", file.display(), by.display())
        };
        outside.map(note).collect()
    }
}

/// The content of `capture.json`.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct ListedCapture {
    photographs: Vec<ListedPhotograph>,
    transfer: Option<Albedo>,
    #[serde(default)]
    falloff: bool,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct ListedPhotograph {
    /// Relative to the folder of the list.
    file: PathBuf,
    scene: Scene,
}

impl ListedCapture {
    fn capture(self, path: &Path, list: &Path) -> Result<Capture, String> {
        let photograph = |one: &ListedPhotograph| CapturedPhotograph {
            name: line(&one.file.display().to_string()),
            file: NamedFile::within(&one.file, list),
            scene: one.scene,
            transfer: self.transfer,
        };
        let photographs = self.photographs.iter().map(photograph).collect();
        Ok(Capture { path: path.to_owned(), photographs, falloff: self.falloff })
    }
}

/// The `render.json` of MaterialGAN (Guo et al. 2020), later `parameters.json`: positions in centimetres. Its renderer stores the power
/// 1 / 2.2 of radiance, which falls off with the distance of the light.
#[derive(Debug, Deserialize)]
pub struct Calibration {
    /// The width of the material in centimetres.
    #[serde(alias = "image_size")]
    im_size: f64,
    camera_pos: Vec<[f64; 3]>,
    light_pos: Vec<[f64; 3]>,
    /// The numbers of the photographs, which also name their files; without, all.
    idx: Option<Vec<usize>>,
    /// The power of the light, RGB.
    light_pow: Option<[f64; 3]>,
    /// The folder of the photographs.
    target_dir: Option<PathBuf>,
}

impl Calibration {
    /// The key by which a calibration is told from other JSON.
    const KEY: &str = "\"camera_pos\"";

    /// The scene of each photograph, in units of half the width of the material.
    ///
    /// # Errors
    /// The problem, where the numbers make no sense.
    pub fn scenes(&self) -> Result<Vec<Scene>, String> {
        if !self.im_size.is_finite() || self.im_size <= 0.0 {
            return Err(format!("its im_size is {}, not a width", self.im_size));
        }
        if self.camera_pos.len() != self.light_pos.len() {
            let [cameras, lights] = [self.camera_pos.len(), self.light_pos.len()];
            return Err(format!("it lists {cameras} camera_pos and {lights} light_pos"));
        }
        let scaled = |position: [f64; 3]| position.map(|c| c * 2.0 / self.im_size);
        let scene = |index: usize| {
            let missing = || format!("its idx names position {index} of {}", self.camera_pos.len());
            let camera = *self.camera_pos.get(index).ok_or_else(missing)?;
            Ok(Scene { kind: Kind::Near, view: scaled(camera), light: scaled(self.light_pos[index]) })
        };
        self.numbers().into_iter().map(scene).collect()
    }

    fn numbers(&self) -> Vec<usize> {
        self.idx.clone().unwrap_or_else(|| (0..self.camera_pos.len()).collect())
    }

    fn photographs(&self, list: &Path) -> Result<Vec<CapturedPhotograph>, String> {
        let folder =
            self.target_dir.as_ref().ok_or("its target_dir, the folder of the photographs, is missing")?;
        if let Some([r, g, b]) = self.light_pow.filter(|[r, g, b]| r != g || g != b) {
            return Err(format!(
                "expected a white light, found the light_pow {r}, {g}, {b}: divide the photographs by its colour"
            ));
        }
        let photograph = |(number, scene): (usize, Scene)| {
            let name = format!("{number:02}.png");
            let file = NamedFile::within(folder.join(&name), list);
            CapturedPhotograph { name, file, scene, transfer: Some(Albedo::Gamma22) }
        };
        Ok(self.numbers().into_iter().zip(self.scenes()?).map(photograph).collect())
    }
}
