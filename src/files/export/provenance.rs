//! Provenance of a picture: everything that makes it again.

use svbrdf_core::model::convention::Convention;
use svbrdf_core::model::scene::{Kind, Scene};
use svbrdf_core::picture::content::PictureContent;

use crate::disk::atomic;

/// The metadata of a picture: (keyword, text).
pub type Entries = [(&'static str, String)];

/// The content of a picture, and how it was rendered.
#[derive(Clone, Debug)]
pub struct Provenance {
    pub content: PictureContent,
    pub scene: Scene,
    pub convention: Convention,
    /// Stops by which the renderings of a PNG are brightened; an EXR keeps the radiance as it is.
    pub exposure_ev: f32,
    /// The names of the materials, from left to right; of differences the ground truth first.
    pub sources: Vec<String>,
    /// Its renderer: the CPU or the name of an adapter.
    pub renderer: String,
}

impl Provenance {
    /// The program and its version.
    pub const SOFTWARE: &str = atomic::SOFTWARE;

    /// Replaces the text about the content of a picture.
    pub fn describe(entries: &mut [(&'static str, String)], shows: String) {
        if let Some(entry) = entries.iter_mut().find(|(key, _)| *key == Self::SHOWS) {
            entry.1 = shows;
        }
    }

    const SHOWS: &str = "svbrdf:shows";

    /// Everything but the program as (keyword, text), in a fixed order.
    pub fn entries(&self) -> Vec<(&'static str, String)> {
        let [view, light] = [self.scene.view, self.scene.light].map(|[x, y, z]| format!("{x},{y},{z}"));
        let kind = match self.scene.kind {
            Kind::Near => "near",
            Kind::Distant => "distant",
        };
        vec![
            (Self::SHOWS, self.content.text(self.convention.epsilon)),
            ("svbrdf:sources", self.sources.join(" | ")),
            ("svbrdf:convention", self.convention.name.to_owned()),
            ("svbrdf:kind", kind.to_owned()),
            ("svbrdf:view", view),
            ("svbrdf:light", light),
            ("svbrdf:exposure", format!("{} EV", self.exposure_ev)),
            ("svbrdf:renderer", self.renderer.clone()),
        ]
    }
}
