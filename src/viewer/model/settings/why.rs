//! State of the tab *Why*: its unfolded sections, the endpoint that moves, and the number of listed scenes.

use serde::{Deserialize, Serialize};

use svbrdf_core::model::scene::Endpoint;

/// Scenes in the panel until more are asked for.
const FEW: usize = 10;

/// What the tab shows, besides its sections, which persist.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct WhyState {
    /// The endpoint that moves over the hemisphere.
    pub moved: Endpoint,
    /// Number of listed scenes.
    pub listed: usize,
}

impl Default for WhyState {
    fn default() -> Self {
        Self { moved: Endpoint::Light, listed: FEW }
    }
}

/// A section of the tab that can be folded; what is folded is not computed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum WhySection {
    /// Whether an error of exposure, alignment or reading explains the loss.
    Diagnosis,
    /// Those of its hypotheses that have no mark.
    Hypotheses,
    /// How much of the loss comes from each map.
    Maps,
    /// Which scenes the loss comes from.
    Scenes,
    /// The loss over the directions of light or view.
    Directions,
}

/// Which sections are unfolded.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default)]
pub struct WhySections {
    diagnosis: bool,
    hypotheses: bool,
    maps: bool,
    scenes: bool,
    directions: bool,
}

impl Default for WhySections {
    fn default() -> Self {
        Self { diagnosis: true, hypotheses: false, maps: true, scenes: true, directions: true }
    }
}

impl WhySections {
    pub fn is_open(self, section: WhySection) -> bool {
        match section {
            WhySection::Diagnosis => self.diagnosis,
            WhySection::Hypotheses => self.hypotheses,
            WhySection::Maps => self.maps,
            WhySection::Scenes => self.scenes,
            WhySection::Directions => self.directions,
        }
    }

    pub fn open(&mut self, section: WhySection, on: bool) {
        match section {
            WhySection::Diagnosis => self.diagnosis = on,
            WhySection::Hypotheses => self.hypotheses = on,
            WhySection::Maps => self.maps = on,
            WhySection::Scenes => self.scenes = on,
            WhySection::Directions => self.directions = on,
        }
    }
}
