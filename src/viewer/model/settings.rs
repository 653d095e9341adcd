//! Settings that persist from one start to the next.

use std::collections::BTreeSet;

use serde::{Deserialize, Serialize};

use svbrdf_core::loss::LossSettings;

/// The questions that the side panel answers, one at a time.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Tab {
    /// Which prediction is better? Of a data set: which method?
    #[default]
    #[serde(alias = "Methods")]
    Loss,
    /// Where and by what is it wrong?
    Why,
    /// Is each material read rightly?
    Files,
}

impl Tab {
    /// Every tab with its name and its question.
    pub const ALL: [(Self, &'static str, &'static str); 3] = [
        (Self::Loss, "Loss", "Which prediction is better?"),
        (Self::Why, "Why", "Where and by what is a prediction wrong?"),
        (Self::Files, "Files", "Is each material read rightly?"),
    ];
}

/// Persistent settings. Every field has a default.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Settings {
    pub dark: bool,
    pub side_panel: bool,
    /// Whether a drag in a pane has ever done something.
    pub has_dragged: bool,
    /// Width of the side panel, in points.
    pub side_width: f32,
    /// Width of the list of materials, in points, where it was changed.
    pub list_width: Option<f32>,
    /// Whether a left-drag moves the highlight under the pointer, instead of the light.
    pub highlight_follows: bool,
    /// Size of the window's text and controls: 1 is the size of the system.
    pub ui_scale: f32,
    /// Width and height of the last window, in points.
    pub window: Option<[f32; 2]>,
    /// The tab of the side panel.
    pub tab: Tab,
    /// The unfolded sections of the tab *Why*.
    pub sections: WhySections,
    pub loss: LossSettings,
    /// The name of the graphics adapter that is taken where it is there.
    pub adapter: Option<String>,
    /// Whether files that change on disk are read again.
    pub watch: bool,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            dark: true,
            side_panel: true,
            has_dragged: false,
            side_width: 320.0,
            list_width: None,
            highlight_follows: false,
            ui_scale: 1.0,
            window: None,
            tab: Tab::Loss,
            sections: WhySections::default(),
            loss: LossSettings::default(),
            adapter: None,
            watch: false,
        }
    }
}

impl Settings {
    /// The settings for the next start, which begins without the scenes of a file: they belong to the materials that are open,
    /// and come back with their session.
    #[must_use]
    pub fn for_next_start(&self) -> Self {
        Self { loss: self.loss.with_file(None), ..self.clone() }
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

    /// Unfolds a section, or folds it.
    pub fn toggle(&mut self, section: WhySection) {
        if !self.0.remove(section.name()) {
            self.0.insert(section.name().to_owned());
        }
    }
}
