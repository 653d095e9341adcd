//! Captures: photographs of one material, each with its light and view.
//!
//! A capture is a folder with a `capture.json` (`docs/photographs.md`), one of MaterialGAN, or a single photograph.

use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use svbrdf_core::model::scene::Scene;

use super::corners::Corners;
use super::materialgan::{LightPower, TEXTS};
use crate::disk::open::NamedFile;
use crate::error::Error;
use crate::read::{Photograph, PhotographOptions, Transfer, read_named_photograph};

/// The photographs of a material, with their lights and views.
#[derive(Clone, Debug, PartialEq)]
pub struct Capture {
    /// The path that a user gave: of a photograph, a folder, or the file that lists the photographs.
    pub path: PathBuf,
    /// The file that lists them; `None`: the path is that of the one photograph.
    pub file: Option<PathBuf>,
    /// Whether it is one of MaterialGAN.
    pub is_materialgan: bool,
    /// At least one; their names differ.
    pub photographs: Vec<CapturedPhotograph>,
    /// Whether the falloff of the light is divided out of the photographs.
    pub falloff: bool,
    /// The power of the light, where the file has it.
    pub power: Option<LightPower>,
}

/// A photograph of a capture, to be read.
#[derive(Clone, Debug, PartialEq)]
pub struct CapturedPhotograph {
    /// The name of its file in the capture.
    pub name: String,
    pub file: NamedFile,
    pub scene: Scene,
    /// `None`: the whole picture.
    pub corners: Option<Corners>,
    pub options: PhotographOptions,
}

/// A photograph and how it is used, as the command line gives it and a session stores it. It is taken in the scene of the session.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub struct SessionPhotograph {
    /// Its file. In a file, it is relative to the folder of the file.
    pub path: PathBuf,
    /// How it is read; what is not specified is inferred.
    #[serde(default)]
    pub read: PhotographOptions,
    /// The corners of the material. `None` for the whole picture.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub corners: Option<Corners>,
    /// Whether the falloff of the light is divided out.
    #[serde(default)]
    pub falloff: bool,
    /// The file that lists the capture to which it belongs. In a file, it is relative to the folder of the file.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub capture: Option<PathBuf>,
}

pub(super) fn is_json(path: &Path) -> bool {
    path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("json"))
}

impl CapturedPhotograph {
    /// Reads it, with the corners of the material in it.
    ///
    /// # Errors
    /// As [`crate::read::read_photograph`], and [`Error::UnusableCorners`].
    pub fn read(&self) -> Result<(Photograph, Corners), Error> {
        let photograph = read_named_photograph(&self.file, &self.options)?;
        let corners = self.corners.unwrap_or_else(|| Corners::whole(photograph.size()));
        corners.check(photograph.size())?;
        Ok((photograph, corners))
    }

    /// Whether `name` is its name, with or without extension.
    pub fn is_called(&self, name: &str) -> bool {
        self.name == name || Path::new(&self.name).with_extension("") == Path::new(name)
    }

    /// The source of the transfer curve.
    pub fn transfer_from(&self, photograph: &Photograph, is_materialgan: bool) -> &'static str {
        match is_materialgan && self.options.transfer == Some(Transfer::Gamma22) {
            true => "as MaterialGAN encodes",
            false => photograph.transfer_from,
        }
    }
}

impl Capture {
    /// One photograph, taken in this scene.
    pub fn of_one(photograph: SessionPhotograph, scene: Scene) -> Self {
        let SessionPhotograph { path, read: options, corners, falloff, .. } = photograph;
        let (name, file) = (path.display().to_string(), NamedFile::by_user(&path));
        let photographs = vec![CapturedPhotograph { name, file, scene, corners, options }];
        Self { path, file: None, is_materialgan: false, photographs, falloff, power: None }
    }

    /// A note about each photograph outside of the folder of the file that lists it.
    pub fn outside(&self) -> Vec<String> {
        let outside = self.photographs.iter().filter_map(|one| Some((one.file.path(), one.file.outside()?)));
        let note = |(file, by): (&Path, &Path)| {
            format!("{} lies outside of the folder of {}, which names it", file.display(), by.display())
        };
        outside.map(note).collect()
    }

    /// Whether a path may be that of a capture: a folder, JSON, or the first of the text files of MaterialGAN.
    pub fn is_named(path: &Path) -> bool {
        is_json(path) || path.file_name().is_some_and(|name| name == TEXTS[0]) || path.is_dir()
    }

    /// The photograph at this index, as a session keeps it, and its light and view; `None` beyond the last.
    pub fn session_photograph(&self, index: usize) -> Option<(SessionPhotograph, Scene)> {
        let one = self.photographs.get(index)?;
        let photograph = SessionPhotograph {
            path: one.file.path().to_owned(),
            read: one.options,
            corners: one.corners,
            falloff: self.falloff,
            capture: self.file.clone(),
        };
        Some((photograph, one.scene))
    }

    /// The photographs as they are read with these options, where they are specified.
    #[must_use]
    pub fn with_options(mut self, options: &PhotographOptions) -> Self {
        for one in &mut self.photographs {
            one.options.transfer = options.transfer.or(one.options.transfer);
            one.options.clip = options.clip.or(one.options.clip);
        }
        self
    }

    /// The names of the photographs at the indices that are `wanted`.
    pub fn names(&self, wanted: impl Fn(usize) -> bool) -> String {
        let of = self.photographs.iter().enumerate().filter(|(index, _)| wanted(*index));
        of.map(|(_, one)| one.name.as_str()).collect::<Vec<_>>().join(", ")
    }
}
