//! State of the view: light, view and display as one value, which undo covers.

use svbrdf_core::material::{Grid, Map};
use svbrdf_core::model::convention::Convention;
use svbrdf_core::model::scene::{Kind, Scene};
use svbrdf_core::picture::camera::Camera;
use svbrdf_core::picture::difference::Difference;
use svbrdf_core::picture::quantity::Quantity;
use svbrdf_evaluate::diagnose::Change;
use svbrdf_files::convention::ChosenConvention;
use svbrdf_files::session::window::SessionDisplay;
pub use svbrdf_files::session::window::{AutoExposure, Layout, Projection};
use svbrdf_files::source::Place;

/// Greatest exposure either way, in stops.
pub const STOPS: f32 = 20.0;

/// What the exposure was last computed for.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum Exposed {
    /// It is to be computed as soon as there is a ground truth.
    #[default]
    Pending,
    /// It was saved with a session or a moment of the history, and holds for the materials of that.
    Restored,
    For {
        ground_truth: Place,
        scene: Scene,
        convention: Convention,
    },
}

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

    /// Sets the exposure by hand.
    pub fn set_exposure(&mut self, ev: f32) {
        self.exposure_ev = ev.clamp(-STOPS, STOPS);
        self.display.auto_exposure = AutoExposure::Off;
    }

    /// Chooses a prediction. A correction is of one prediction.
    pub fn choose(&mut self, prediction: usize) {
        if prediction != self.display.prediction {
            (self.display.prediction, self.display.corrected) = (prediction, None);
        }
    }

    /// Shows the chosen prediction with this map alone wrong, or right; `None` shows the prediction itself.
    pub fn isolate(&mut self, map: Option<Map>) {
        (self.display.isolated, self.display.corrected) = (map, None);
    }

    /// Shows the chosen prediction with a change that a diagnosis found; `None` shows the prediction itself.
    pub fn correct(&mut self, change: Option<Change>) {
        (self.display.isolated, self.display.corrected) = (None, change);
    }

    pub fn show_error_map(&mut self) {
        (self.display.quantity, self.display.difference) = (Quantity::Rendering, true);
        self.display.differences.choose_error_map();
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

/// Sizes and places of the last frame.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct WindowGeometry {
    /// Width and height of the picture of a pane, in physical pixels; 0 before there is one.
    pub pane: [f32; 2],
    /// Width and height of the panes and the legend together, in pixels.
    pub picture: [u32; 2],
    /// Width and height of the window, in points.
    pub window: [f32; 2],
    /// Whether the side panel is closed until it is asked for.
    pub is_narrow: bool,
    /// The texel that was under the pointer last.
    pub texel: Option<[usize; 2]>,
}
