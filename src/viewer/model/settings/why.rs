//! State of the tab *Why*: its unfolded sections, and the number of listed scenes.

use std::collections::BTreeSet;

use serde::{Deserialize, Serialize};

/// Scenes in the panel until more are asked for.
const FEW: usize = 10;

/// What the tab shows, besides its sections, which persist.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct WhyState {
    /// Number of listed scenes.
    pub listed: usize,
}

impl Default for WhyState {
    fn default() -> Self {
        Self { listed: FEW }
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
    /// The table of the analysis of this name.
    Table(&'static str),
}

impl WhySection {
    fn name(self) -> &'static str {
        match self {
            Self::Diagnosis => "diagnosis",
            Self::Hypotheses => "hypotheses",
            Self::Maps => "maps",
            Self::Scenes => "scenes",
            Self::Table(name) => name,
        }
    }
}

/// Which sections are unfolded, by their names.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct WhySections(BTreeSet<String>);

impl Default for WhySections {
    fn default() -> Self {
        let open = [WhySection::Diagnosis, WhySection::Maps, WhySection::Scenes];
        Self(open.into_iter().map(|section| section.name().to_owned()).collect())
    }
}

impl WhySections {
    pub fn is_open(&self, section: WhySection) -> bool {
        self.0.contains(section.name())
    }

    pub fn open(&mut self, section: WhySection, on: bool) {
        match on {
            true => self.0.insert(section.name().to_owned()),
            false => self.0.remove(section.name()),
        };
    }
}
