//! `capture.json`: the project's own description of a capture.

use std::path::{Path, PathBuf};

use serde::Deserialize;

use svbrdf_core::model::scene::Scene;
use svbrdf_core::text::line;

use super::capture::CapturedPhotograph;
use super::corners::Corners;
use crate::disk::open::NamedFile;
use crate::read::{PhotographOptions, Transfer};

/// The content of the file.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ListedCapture {
    photographs: Vec<Entry>,
    /// Of photographs without their own, as the three below.
    transfer: Option<Transfer>,
    clip: Option<f64>,
    corners: Option<Corners>,
    /// Whether the falloff of the light is divided out of the photographs.
    #[serde(default)]
    pub falloff: bool,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Entry {
    /// Relative to the folder of `capture.json`.
    file: PathBuf,
    scene: Scene,
    transfer: Option<Transfer>,
    clip: Option<f64>,
    corners: Option<Corners>,
}

impl ListedCapture {
    /// The photographs that the file `by` lists.
    ///
    /// # Errors
    /// The problem of one of them.
    pub fn photographs(&self, by: &Path) -> Result<Vec<CapturedPhotograph>, String> {
        self.photographs.iter().enumerate().map(|(i, entry)| self.photograph(i, entry, by)).collect()
    }

    fn photograph(&self, index: usize, entry: &Entry, by: &Path) -> Result<CapturedPhotograph, String> {
        let (transfer, clip) = (entry.transfer.or(self.transfer), entry.clip.or(self.clip));
        let options = PhotographOptions { transfer, clip, light_colour: None };
        options.check().map_err(|problem| format!("photograph {index}: {problem}"))?;
        Ok(CapturedPhotograph {
            name: line(&entry.file.display().to_string()),
            file: NamedFile::within(&entry.file, by),
            scene: entry.scene,
            corners: entry.corners.or(self.corners),
            options,
        })
    }
}
