//! The buttons of the bar at the top: their icons, names and commands, and how much room each needs.

use egui_material_icons::icons;

use crate::model::command::{Command, DisplayCommand, WindowCommand};

/// How much room the bar has: what does not fit into one line is in the menu.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Room {
    Little,
    Some,
    Full,
}

impl Room {
    /// Of a bar of this width, in points.
    pub fn of(width: f32) -> Self {
        match width {
            1130.0.. => Self::Full,
            860.0.. => Self::Some,
            _ => Self::Little,
        }
    }
}

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

    /// The least room in which it is in the bar.
    pub fn needs(self) -> Room {
        match self {
            Self::Perspective => Room::Little,
            Self::Swap | Self::Fit | Self::Reset => Room::Some,
            _ => Room::Full,
        }
    }

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
