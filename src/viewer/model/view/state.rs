//! State of the view: light, view and display as one value, which undo covers.

use serde::{Deserialize, Serialize};

use crate::material::{Grid, Map};
use crate::model::convention::{self, Convention};
use crate::model::scene::{Kind, Scene};
use crate::picture::camera::Camera;
use crate::picture::difference::Difference;
use crate::picture::differences::Differences;
use crate::picture::quantity::Quantity;

/// How the panes are arranged.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Layout {
    /// The ground truth and every prediction, each in its own pane.
    #[default]
    SideBySide,
    /// Ground truth left and chosen prediction right of a line, in one pane.
    Wipe,
    /// The chosen prediction alone.
    Single,
}

impl Layout {
    pub const ALL: [Self; 3] = [Self::SideBySide, Self::Wipe, Self::Single];

    pub fn name(self) -> &'static str {
        match self {
            Self::SideBySide => "side by side",
            Self::Wipe => "wipe",
            Self::Single => "single",
        }
    }
}

/// How the material is projected into a pane.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Projection {
    /// As a flat texture, texel by texel.
    #[default]
    Flat,
    /// As a plane, seen from the view position.
    Perspective,
}

impl Projection {
    pub fn other(self) -> Self {
        match self {
            Self::Flat => Self::Perspective,
            Self::Perspective => Self::Flat,
        }
    }
}

/// Light, view and display, as one value: undo returns to an earlier one.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct ViewState {
    pub scene: Scene,
    pub quantity: Quantity,
    /// Whether panes of predictions show their difference from the ground truth, in place of the value.
    pub difference: bool,
    /// The chosen difference and the range of each quantity.
    pub differences: Differences,
    pub layout: Layout,
    pub projection: Projection,
    /// Exposure in stops: radiance is multiplied by 2^exposure_ev.
    pub exposure_ev: f32,
    pub show_clipping: bool,
    /// Whether the material is repeated 2 x 2 times, shifted by half of itself: shows its seams.
    #[serde(default)]
    pub tiled: bool,
    /// Whether roughness is shown in false colours.
    #[serde(default)]
    pub false_colour: bool,
    /// Position of the wipe line: 0 at the left edge of the pane, 1 at the right.
    pub wipe: f32,
    /// Magnification; at 1 the material fits its pane.
    pub zoom: f32,
    /// Where the centre of the picture is in its pane, x right and y up in [-1, 1].
    pub pan: [f32; 2],
    /// The name of the convention of renderings and loss.
    pub convention: String,
    /// The chosen prediction: its index among the predictions.
    pub prediction: usize,
    /// The map that is shown as the only wrong one, or the only right one, of the chosen prediction.
    pub isolated: Option<Map>,
    /// Whether [`ViewState::isolated`] is the only right one, and not the only wrong one.
    pub only_right: bool,
}

impl Default for ViewState {
    fn default() -> Self {
        Self {
            scene: Scene { kind: Kind::Near, view: [0.0, 0.0, 2.5], light: [0.4, 0.5, 1.2] },
            quantity: Quantity::Rendering,
            difference: false,
            differences: Differences::default(),
            layout: Layout::SideBySide,
            projection: Projection::Flat,
            exposure_ev: 0.0,
            show_clipping: false,
            tiled: false,
            false_colour: false,
            wipe: 0.5,
            zoom: 1.0,
            pan: [0.0, 0.0],
            convention: convention::PRINTED.name.to_owned(),
            prediction: 0,
            isolated: None,
            only_right: false,
        }
    }
}

impl ViewState {
    /// The convention of that name; the default where the name is not known.
    pub fn convention(&self) -> Convention {
        self.convention.parse().unwrap_or_default()
    }

    /// The chosen difference of the quantity.
    pub fn difference_kind(&self) -> Difference {
        self.differences.kind(self.quantity)
    }

    /// Whether the difference is the error map, which averages over scenes.
    pub fn is_error_map(&self) -> bool {
        self.differences.is_error_map(self.quantity)
    }

    /// The name of the chosen difference.
    pub fn difference_name(&self) -> &'static str {
        if self.is_error_map() { "error map" } else { self.difference_kind().name() }
    }

    /// The camera that fits the material into a pane of `aspect` = width / height, before zoom and pan.
    pub fn fitted_camera(&self, grid: Grid, aspect: f32) -> Camera {
        match self.projection {
            Projection::Flat => Camera::flat(grid, aspect),
            Projection::Perspective => Camera::of_scene(&self.scene, grid, aspect),
        }
    }

    /// The texel that is seen at a point of the plane.
    pub fn texel_at(&self, grid: Grid, point: [f32; 2]) -> Option<[usize; 2]> {
        if self.tiled { grid.repeated_texel_at(point) } else { grid.texel_at(point) }
    }

    /// The default light, view and display, with the current prediction, layout and convention.
    #[must_use]
    pub fn reset(&self) -> Self {
        Self {
            layout: self.layout,
            quantity: self.quantity,
            difference: self.difference,
            differences: self.differences.clone(),
            projection: self.projection,
            convention: self.convention.clone(),
            tiled: self.tiled,
            false_colour: self.false_colour,
            prediction: self.prediction,
            isolated: self.isolated,
            only_right: self.only_right,
            ..Self::default()
        }
    }
}
