//! Sections of the tab *Why* that are unfolded.

use std::collections::BTreeSet;

use serde::{Deserialize, Serialize};

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

    /// Unfolds a section, or folds it.
    pub fn toggle(&mut self, section: WhySection) {
        if !self.0.remove(section.name()) {
            self.0.insert(section.name().to_owned());
        }
    }
}
