//! The sections of the tab.

use serde::{Deserialize, Serialize};

/// A section of the tab that can be folded; what is folded is not computed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum WhySection {
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
    maps: bool,
    scenes: bool,
    directions: bool,
}

impl Default for WhySections {
    fn default() -> Self {
        Self { maps: true, scenes: true, directions: true }
    }
}

impl WhySections {
    pub fn is_open(self, section: WhySection) -> bool {
        match section {
            WhySection::Maps => self.maps,
            WhySection::Scenes => self.scenes,
            WhySection::Directions => self.directions,
        }
    }

    pub fn open(&mut self, section: WhySection, on: bool) {
        match section {
            WhySection::Maps => self.maps = on,
            WhySection::Scenes => self.scenes = on,
            WhySection::Directions => self.directions = on,
        }
    }
}
