//! Where a picture comes from: what it takes to make it again.

use crate::model::convention::Convention;
use crate::model::scene::{Kind, Scene};
use crate::picture::colour_map::FULL_DIFFERENCE;

/// What the numbers of a picture are.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Shows {
    /// Linear radiance.
    #[default]
    Radiance,
    /// How far the logarithms of predictions are from those of the ground truth; a PNG has them as colours.
    LogDifference,
}

/// What a file says about its picture: (keyword, text).
pub type Entries = [(&'static str, String)];

/// What a picture shows, and how.
#[derive(Clone, Debug)]
pub struct Provenance {
    pub shows: Shows,
    pub scene: Scene,
    pub convention: Convention,
    /// Stops by which a PNG is brightened; an EXR keeps the radiance as it is.
    pub exposure_ev: f32,
    /// The names of the materials, from left to right; of differences the ground truth first.
    pub sources: Vec<String>,
    /// What rendered it: the CPU or the name of an adapter.
    pub renderer: String,
}

impl Provenance {
    /// The program and its version.
    pub const SOFTWARE: &str = concat!("svbrdf ", env!("CARGO_PKG_VERSION"));

    /// Everything but the program as (keyword, text), in a fixed order.
    pub fn entries(&self) -> Vec<(&'static str, String)> {
        let [view, light] = [self.scene.view, self.scene.light].map(|[x, y, z]| format!("{x},{y},{z}"));
        let kind = match self.scene.kind {
            Kind::Near => "near",
            Kind::Distant => "distant",
        };
        let shows = match self.shows {
            Shows::Radiance => "radiance".to_owned(),
            Shows::LogDifference => {
                let epsilon = self.convention.epsilon;
                format!(
                    "|ln(prediction + {epsilon}) - ln(ground truth + {epsilon})|, {FULL_DIFFERENCE} the last colour at 0 EV"
                )
            }
        };
        vec![
            ("svbrdf:shows", shows),
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
