//! Kinds of files that the window saves.

use std::path::PathBuf;

/// A file that is written.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SaveRequest {
    pub kind: SaveKind,
    pub path: PathBuf,
}

/// What is saved.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum SaveKind {
    /// The panes and the legend, as they are seen.
    #[default]
    View,
    /// Every material's whole picture, side by side, as `svbrdf render` writes.
    Renderings,
    /// A labelled figure of all maps, the rendering and its difference, as `svbrdf strip` writes.
    Strip,
    /// An interactive page of the comparison with its findings, as `svbrdf report` writes.
    Report,
    /// Files, assumptions, scene, display and loss settings.
    Session,
    /// The scenes of the loss of the chosen prediction, as `svbrdf scenes` writes.
    Scenes,
    /// The list of materials of a data set, with marks, notes and losses.
    Materials,
}

impl SaveKind {
    /// The kinds of a single comparison.
    pub const ALL: [Self; 6] =
        [Self::View, Self::Renderings, Self::Strip, Self::Report, Self::Session, Self::Scenes];

    /// The one of a data set beside them.
    pub const OF_DATASET: [Self; 1] = [Self::Materials];

    /// The label of its button.
    pub fn name(self) -> &'static str {
        match self {
            Self::View => "View",
            Self::Renderings => "Renderings",
            Self::Strip => "Strip",
            Self::Report => "Report",
            Self::Session => "Session",
            Self::Scenes => "Scenes",
            Self::Materials => "List",
        }
    }

    /// What the file holds.
    pub fn explanation(self) -> &'static str {
        match self {
            Self::View => {
                "The panes and the legend as they are seen, with light, view, exposure and convention in the file's \
                 metadata."
            }
            Self::Renderings => {
                "The rendering, map or difference that is selected, of every material side by side, one pixel per texel; \
                 the same as `svbrdf render` writes. PNG as displayed, EXR as linear floats."
            }
            Self::Strip => {
                "A labelled figure: a row per material; all maps, the rendering and its difference in columns; a rectangle \
                 (Q) framed and magnified; the same as `svbrdf strip` writes."
            }
            Self::Report => {
                "One HTML file for any browser, offline: the figure with light and view to drag, losses, the share of each \
                 map, the worst scenes; the same as `svbrdf report` writes. Takes as long as a loss and its attribution."
            }
            Self::Session => {
                "Paths of the files (relative to this one), assumptions, scene, display and loss settings. `svbrdf` opens \
                 it, and so does Open."
            }
            Self::Scenes => {
                "The scenes that the tab Why lists for the chosen prediction, worst first, with their losses. Open takes \
                 them as the scenes of the loss, and so does --scenes of `svbrdf`."
            }
            Self::Materials => {
                "The materials that are listed, in their order, as CSV: mark, note and the loss of each method."
            }
        }
    }

    /// The name that the dialog proposes.
    pub fn proposal(self) -> &'static str {
        match self {
            Self::View => "svbrdf-view.png",
            Self::Renderings => "svbrdf-renderings.png",
            Self::Strip => "svbrdf-strip.png",
            Self::Report => "svbrdf-report.html",
            Self::Session => "comparison.svbrdf-session.json",
            Self::Scenes => "scenes.json",
            Self::Materials => "materials.csv",
        }
    }
}
