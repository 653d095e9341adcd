//! The buttons of the bar at the top: their icons, names and commands, and how much room each needs.

use egui_material_icons::icons;

use crate::model::command::{Command, DisplayCommand, WindowCommand};

/// What of the bar has room in its line. The rest is in the menu.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Room {
    pub exposure: bool,
    pub items: Vec<BarItem>,
}

impl Room {
    /// The parts that fit into `width`, the most needed ones first; each needs what `width_of` says, `None` being the exposure.
    pub fn new(mut width: f32, width_of: impl Fn(Option<BarItem>) -> f32) -> Self {
        let mut room = Self { exposure: false, items: Vec::new() };
        for part in NEEDED {
            width -= width_of(part);
            match part {
                _ if width < 0.0 => break,
                Some(item) => room.items.push(item),
                None => room.exposure = true,
            }
        }
        room
    }

    pub fn has(&self, item: BarItem) -> bool {
        self.items.contains(&item)
    }
}

/// The parts of the bar that may be in the menu, the most needed one first; `None` is the exposure.
const NEEDED: [Option<BarItem>; 13] = [
    Some(BarItem::Perspective),
    None,
    Some(BarItem::Fit),
    Some(BarItem::Reset),
    Some(BarItem::Swap),
    Some(BarItem::Tile),
    Some(BarItem::Undo),
    Some(BarItem::Redo),
    Some(BarItem::Histogram),
    Some(BarItem::OneToOne),
    Some(BarItem::Clip),
    Some(BarItem::FalseColour),
    Some(BarItem::Copy),
];

/// A button that is in the bar where there is room, and in the menu otherwise.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BarItem {
    Copy,
    Histogram,
    Perspective,
    Tile,
    FalseColour,
    Swap,
    Clip,
    Fit,
    OneToOne,
    Reset,
    Undo,
    Redo,
}

impl BarItem {
    pub const ALL: [Self; 12] = [
        Self::Copy,
        Self::Histogram,
        Self::Perspective,
        Self::Tile,
        Self::FalseColour,
        Self::Swap,
        Self::Clip,
        Self::Fit,
        Self::OneToOne,
        Self::Reset,
        Self::Undo,
        Self::Redo,
    ];

    /// A letter of the icon font, or a short text.
    pub fn icon(self) -> &'static str {
        match self {
            Self::Copy => icons::ICON_CONTENT_COPY.codepoint,
            Self::Histogram => icons::ICON_BAR_CHART.codepoint,
            Self::Perspective => icons::ICON_VIEW_IN_AR.codepoint,
            Self::Tile => icons::ICON_GRID_VIEW.codepoint,
            Self::FalseColour => icons::ICON_PALETTE.codepoint,
            Self::Swap => icons::ICON_SWAP_HORIZ.codepoint,
            Self::Clip => icons::ICON_BRIGHTNESS_ALERT.codepoint,
            Self::Fit => icons::ICON_FIT_SCREEN.codepoint,
            Self::OneToOne => "1:1",
            Self::Reset => icons::ICON_RESTART_ALT.codepoint,
            Self::Undo => icons::ICON_UNDO.codepoint,
            Self::Redo => icons::ICON_REDO.codepoint,
        }
    }

    pub fn name(self) -> &'static str {
        match self {
            Self::Copy => "Copy",
            Self::Histogram => "Histogram",
            Self::Perspective => "3D",
            Self::Tile => "Tile",
            Self::FalseColour => "False colour",
            Self::Swap => "Swap",
            Self::Clip => "Clipped pixels",
            Self::Fit => "Fit",
            Self::OneToOne => "One texel per pixel",
            Self::Reset => "Reset",
            Self::Undo => "Undo",
            Self::Redo => "Redo",
        }
    }

    /// What it does, and its key.
    pub fn hover(self) -> &'static str {
        match self {
            Self::Copy => "Copy the view as a picture (Ctrl+Shift+C)",
            Self::Histogram => "Histograms of the values, per channel, of every material (J)",
            Self::Perspective => "The plane seen from the view position, or the flat texture (P)",
            Self::Tile => {
                "Repeat the material 2 × 2 times, shifted by half of itself: shows its seams; for display only (T)"
            }
            Self::FalseColour => "Roughness from 0 (black) to 1 (light yellow) (V)",
            Self::Swap => {
                "Swap prediction and ground truth (X); hold G to show the ground truth in every pane"
            }
            Self::Clip => "Mark clipped pixels: too bright (magenta) or black (blue) (L)",
            Self::Fit => "Fit the material into its pane (F)",
            Self::OneToOne => "One texel per pixel (0)",
            Self::Reset => "Reset light, view, zoom, exposure and clipping marks (R)",
            Self::Undo => "Undo (Ctrl+Z)",
            Self::Redo => "Redo (Ctrl+Shift+Z)",
        }
    }

    pub fn command(self) -> Command {
        match self {
            Self::Copy => WindowCommand::CopyPicture.into(),
            Self::Histogram => WindowCommand::ToggleHistograms.into(),
            Self::Perspective => DisplayCommand::ToggleProjection.into(),
            Self::Tile => DisplayCommand::ToggleTiled.into(),
            Self::FalseColour => DisplayCommand::ToggleFalseColour.into(),
            Self::Swap => DisplayCommand::Swap.into(),
            Self::Clip => DisplayCommand::ToggleClipping.into(),
            Self::Fit => DisplayCommand::Fit.into(),
            Self::OneToOne => DisplayCommand::OneToOne.into(),
            Self::Reset => DisplayCommand::Reset.into(),
            Self::Undo => DisplayCommand::Undo.into(),
            Self::Redo => DisplayCommand::Redo.into(),
        }
    }
}
