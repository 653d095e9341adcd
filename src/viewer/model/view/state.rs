//! State of the view: light, view and display as one value, which undo covers.

use svbrdf_core::material::Grid;
use svbrdf_core::model::convention::Convention;
use svbrdf_core::model::scene::{Kind, Scene};
use svbrdf_core::picture::camera::Camera;
use svbrdf_core::picture::difference::Difference;
use svbrdf_files::convention::ChosenConvention;
use svbrdf_files::session::window::SessionDisplay;

pub use svbrdf_files::session::window::{AutoExposure, Layout, Projection};

/// Light, view and display, as one value: undo returns to an earlier one.
#[derive(Clone, Debug, PartialEq)]
pub struct ViewState {
    pub scene: Scene,
    /// The convention of renderings and loss.
    pub convention: ChosenConvention,
    /// Exposure in stops: radiance is multiplied by 2^exposure_ev.
    pub exposure_ev: f32,
    pub display: SessionDisplay,
}

impl Default for ViewState {
    fn default() -> Self {
        Self {
            scene: Scene { kind: Kind::Near, view: [0.0, 0.0, 2.5], light: [0.4, 0.5, 1.2] },
            convention: ChosenConvention::default(),
            exposure_ev: 0.0,
            display: SessionDisplay::default(),
        }
    }
}

impl ViewState {
    pub fn convention(&self) -> Convention {
        self.convention.convention
    }

    /// The chosen difference of the quantity.
    pub fn difference_kind(&self) -> Difference {
        self.display.differences.kind(self.display.quantity)
    }

    /// Whether the difference is the error map, which averages over scenes.
    pub fn is_error_map(&self) -> bool {
        self.display.differences.is_error_map(self.display.quantity)
    }

    /// Whether the difference is computed as a map, since no shader has it: the error map, or FLIP.
    pub fn is_computed(&self) -> bool {
        self.is_error_map() || self.difference_kind() == Difference::Flip
    }

    /// The name of the chosen difference.
    pub fn difference_name(&self) -> &'static str {
        if self.is_error_map() { "error map" } else { self.difference_kind().name() }
    }

    /// The camera that fits the material into a pane of `aspect` = width / height.
    pub fn fitted_camera(&self, grid: Grid, aspect: f32) -> Camera {
        match self.display.projection {
            Projection::Flat => Camera::flat(grid, aspect),
            Projection::Perspective => Camera::of_scene(&self.scene, grid, aspect),
        }
    }

    /// The default light, view and display, with the current prediction, layout and convention.
    #[must_use]
    pub fn reset(&self) -> Self {
        let SessionDisplay { wipe, framing, show_clipping, auto_exposure, .. } = SessionDisplay::default();
        let display = SessionDisplay { wipe, framing, show_clipping, auto_exposure, ..self.display.clone() };
        Self { convention: self.convention.clone(), display, ..Self::default() }
    }
}
