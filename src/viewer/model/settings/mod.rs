//! Settings that persist from one start to the next.

pub mod loss_query;
pub mod options;
pub mod save_kind;
pub mod why;

use serde::{Deserialize, Serialize};

use svbrdf_core::loss::LossSettings;

use why::WhySections;

/// The questions that the side panel answers, one at a time.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Tab {
    /// Which prediction is better?
    #[default]
    Loss,
    /// Where and by what is it wrong?
    Why,
    /// Is each material read rightly?
    Files,
    /// Which method is better? Of a data set.
    Methods,
}

impl Tab {
    /// Every tab with its name and its question.
    pub const ALL: [(Self, &'static str, &'static str); 4] = [
        (Self::Loss, "Loss", "Which prediction is better?"),
        (Self::Methods, "Methods", "Which method is better over the data set?"),
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
    /// Whether the loss is computed again after every change.
    pub auto_loss: bool,
    pub loss: LossSettings,
    /// Whether files that change on disk are read again.
    pub watch: bool,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            dark: true,
            side_panel: true,
            highlight_follows: false,
            ui_scale: 1.0,
            window: None,
            tab: Tab::Loss,
            sections: WhySections::default(),
            auto_loss: true,
            loss: LossSettings::default(),
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
