//! Captures: photographs of one material, each with its light and view.
//!
//! A capture is a folder with a `capture.json` (`docs/photographs.md`), or one of MaterialGAN. [`CaptureReport`] compares materials
//! with all of its photographs, at one exposure.

mod comparison;
mod find;
mod listed;
mod materialgan;
mod measured;
mod outliers;
mod report;
mod report_json;

use std::path::{Path, PathBuf};

pub use comparison::{CaptureExposure, CaptureReport, CaptureSetting, ReadCaptured};
pub(crate) use materialgan::Calibration;
pub use materialgan::LightPower;
pub use measured::{CaptureGroup, CapturedResult, MaterialResult};
pub use outliers::Outlier;

use serde_json::Value;

use svbrdf_core::error::Error;
use svbrdf_core::model::scene::{Kind, Scene};

use crate::open::NamedFile;
use crate::photograph::Corners;
use crate::read::{Photograph, PhotographOptions, Transfer, read_named_photograph};
use crate::session::SessionPhotograph;
use listed::Listed;

/// Most photographs of a capture.
const MOST: usize = 10_000;

/// The photographs of a material, with their lights and views.
#[derive(Clone, Debug, PartialEq)]
pub struct Capture {
    /// The file that lists them.
    pub file: PathBuf,
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

impl CapturedPhotograph {
    /// Whether `name` is its name, with or without extension.
    fn is_called(&self, name: &str) -> bool {
        self.name == name || Path::new(&self.name).with_extension("") == Path::new(name)
    }

    /// The source of the transfer curve.
    fn transfer_from(&self, photograph: &Photograph, is_materialgan: bool) -> &'static str {
        match is_materialgan && self.options.transfer == Some(Transfer::Gamma22) {
            true => "as MaterialGAN encodes",
            false => photograph.transfer_from,
        }
    }
}

impl Capture {
    /// Reads the description of the capture in the folder `path`, or that file itself. The photographs are not read yet.
    ///
    /// In a folder, it is `capture.json`, or else the only one of the JSON files of MaterialGAN: several may list the same photographs.
    ///
    /// # Errors
    /// [`Error::BadCapture`], [`Error::Unreadable`]; [`Error::Outside`] for a photograph that is named by an absolute path.
    pub fn read(path: &Path) -> Result<Self, Error> {
        let capture = if path.is_dir() {
            find::in_folder(path)?
        } else {
            Self::parse(path, &NamedFile::by_user(path).text()?)?
        };
        capture.photographs.iter().try_for_each(|photograph| photograph.file.check())?;
        Ok(capture)
    }

    /// The files of photographs outside of the folder of the capture.
    pub fn outside(&self) -> impl Iterator<Item = &Path> {
        let outside = self.photographs.iter().filter(|one| one.file.outside().is_some());
        outside.map(|one| one.file.path())
    }

    /// Whether a path may be that of a capture: a folder, or JSON.
    pub fn is_named(path: &Path) -> bool {
        path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("json")) || path.is_dir()
    }

    /// The photograph at this index, as a session keeps it; `None` beyond the last.
    pub fn session_photograph(&self, index: usize) -> Option<SessionPhotograph> {
        let one = self.photographs.get(index)?;
        Some(SessionPhotograph {
            path: one.file.path().to_owned(),
            read: one.options,
            corners: one.corners.map(|corners| corners.0),
            falloff: self.falloff,
            capture: Some(self.file.clone()),
        })
    }

    /// The photographs as they are read with these options, where they are specified.
    pub fn set_options(&mut self, options: &PhotographOptions) {
        for one in &mut self.photographs {
            one.options.transfer = options.transfer.or(one.options.transfer);
            one.options.clip = options.clip.or(one.options.clip);
        }
    }

    /// Reads a photograph, without the colour of the light.
    ///
    /// # Errors
    /// As [`crate::read::read_photograph`], and [`Error::UnusableCorners`].
    pub fn photograph(&self, one: &CapturedPhotograph) -> Result<(Photograph, Corners), Error> {
        let mut photograph = read_named_photograph(&one.file, &one.options)?;
        let corners = one.corners.unwrap_or_else(|| Corners::whole(photograph.size()));
        corners.check(photograph.size())?;
        if let Some(LightPower { colour, .. }) = self.power.filter(|power| !power.is_white()) {
            let gain = colour.map(|channel| channel.recip() as f32);
            let pixels = photograph.image.pixels.iter_mut();
            pixels.for_each(|rgb| (0..3).for_each(|c| rgb[c] *= gain[c]));
        }
        Ok((photograph, corners))
    }

    /// The names of the photographs at the indices that are `wanted`.
    pub fn names(&self, wanted: impl Fn(usize) -> bool) -> String {
        let of = self.photographs.iter().enumerate().filter(|(index, _)| wanted(*index));
        of.map(|(_, one)| one.name.as_str()).collect::<Vec<_>>().join(", ")
    }

    /// The capture that the text of the file at `path` describes.
    fn parse(path: &Path, text: &str) -> Result<Self, Error> {
        let bad = |problem| Error::BadCapture { path: path.to_owned(), problem };
        let value: Value = serde_json::from_str(text).map_err(|e| bad(e.to_string()))?;
        let capture = match value.get("camera_pos").is_some() {
            true => serde_json::from_str(text)
                .map_err(|e| e.to_string())
                .and_then(|calibration| Self::of_materialgan(path, &calibration)),
            false => serde_json::from_str(text)
                .map_err(|e| e.to_string())
                .and_then(|listed| Self::of_list(path, &listed)),
        };
        let capture = capture.map_err(bad)?;
        capture.check().map_err(bad)?;
        Ok(capture)
    }

    fn of_list(path: &Path, listed: &Listed) -> Result<Self, String> {
        let photographs = listed.photographs(path)?;
        let file = path.to_owned();
        Ok(Self { file, is_materialgan: false, photographs, falloff: listed.falloff, power: None })
    }

    /// Its renderer stores the power 1 / 2.2 of radiance, which falls off with the distance of the light.
    fn of_materialgan(path: &Path, calibration: &Calibration) -> Result<Self, String> {
        let folder = calibration
            .target_dir
            .as_ref()
            .ok_or("its target_dir, the folder of the photographs, is missing")?;
        let options = PhotographOptions { transfer: Some(Transfer::Gamma22), clip: None };
        let photograph = |(number, scene): (usize, Scene)| {
            let name = format!("{number:02}.png");
            let file = NamedFile::within(folder.join(&name), path);
            CapturedPhotograph { name, file, scene, corners: None, options }
        };
        let scenes = calibration.scenes()?;
        let photographs = calibration.numbers().into_iter().zip(scenes).map(photograph).collect();
        let (file, power) = (path.to_owned(), calibration.power()?);
        Ok(Self { file, is_materialgan: true, photographs, falloff: true, power })
    }

    fn check(&self) -> Result<(), String> {
        let count = self.photographs.len();
        if !(1..=MOST).contains(&count) {
            return Err(format!("expected 1 to {MOST} photographs, found {count}"));
        }
        let mut names = std::collections::HashSet::new();
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
