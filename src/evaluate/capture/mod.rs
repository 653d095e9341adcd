//! Captures: photographs of one material, each with its light and view.
//!
//! A capture is a folder with a `capture.json` (`docs/photographs.md`), or one of MaterialGAN. [`CaptureReport`] compares materials
//! with all of its photographs, at one exposure.

mod comparison;
mod listed;
mod materialgan;
mod measured;
mod outliers;
mod read;
mod report;

use std::path::{Path, PathBuf};

pub use comparison::{CaptureExposure, CaptureReport, CaptureSetting, ReadCaptured};
pub(crate) use materialgan::Calibration;
pub use materialgan::LightPower;
use materialgan::TEXTS;
pub use measured::{CaptureGroup, CapturedResult, MaterialResult};
pub use outliers::Outlier;

use svbrdf_core::error::Error;
use svbrdf_core::model::scene::Scene;

use svbrdf_files::disk::open::NamedFile;
use crate::photograph::Corners;
use svbrdf_files::read::{Photograph, PhotographOptions, Transfer, read_named_photograph};
use svbrdf_files::session::SessionPhotograph;

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

fn is_json(path: &Path) -> bool {
    path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("json"))
}

impl CapturedPhotograph {
    /// Reads it, with the corners of the material in it.
    ///
    /// # Errors
    /// As [`svbrdf_files::read::read_photograph`], and [`Error::UnusableCorners`].
    pub fn read(&self) -> Result<(Photograph, Corners), Error> {
        let photograph = read_named_photograph(&self.file, &self.options)?;
        let corners = self.corners.unwrap_or_else(|| Corners::whole(photograph.size()));
        corners.check(photograph.size())?;
        Ok((photograph, corners))
    }

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
    /// The files of photographs outside of the folder of the capture.
    pub fn outside(&self) -> impl Iterator<Item = &Path> {
        let outside = self.photographs.iter().filter(|one| one.file.outside().is_some());
        outside.map(|one| one.file.path())
    }

    /// Whether a path may be that of a capture: a folder, JSON, or the first of the text files of MaterialGAN.
    pub fn is_named(path: &Path) -> bool {
        is_json(path) || path.file_name().is_some_and(|name| name == TEXTS[0]) || path.is_dir()
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

    /// The names of the photographs at the indices that are `wanted`.
    pub fn names(&self, wanted: impl Fn(usize) -> bool) -> String {
        let of = self.photographs.iter().enumerate().filter(|(index, _)| wanted(*index));
        of.map(|(_, one)| one.name.as_str()).collect::<Vec<_>>().join(", ")
    }
}
