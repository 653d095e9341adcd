//! What the panes show, and how: everything that undo covers.

use glam::DVec3;
use serde::{Deserialize, Serialize};

use super::differences::Differences;
use crate::model::convention::{self, Convention};
use crate::model::scene::{Kind, Scene};
use crate::picture::difference::Difference;
use crate::picture::quantity::Quantity;

/// Least height of a light or a view in the window: from within the plane nothing is seen.
pub const LOWEST: f64 = 0.01;
/// Largest coordinate of a light or a view in the window.
pub const FARTHEST: f64 = 1000.0;

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
            wipe: 0.5,
            zoom: 1.0,
            pan: [0.0, 0.0],
            convention: convention::PRINTED.name.to_owned(),
            prediction: 0,
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

    /// The default light, view and display, with the prediction, layout and convention of now.
    #[must_use]
    pub fn reset(&self) -> Self {
        Self {
            layout: self.layout,
            quantity: self.quantity,
            difference: self.difference,
            differences: self.differences.clone(),
            projection: self.projection,
            convention: self.convention.clone(),
            prediction: self.prediction,
            ..Self::default()
        }
    }
}

/// Either endpoint of a scene: what a gesture moves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Endpoint {
    Light,
    View,
}

/// The position (or direction) of one endpoint of the scene.
pub fn endpoint(scene: &Scene, which: Endpoint) -> [f64; 3] {
    match which {
        Endpoint::Light => scene.light,
        Endpoint::View => scene.view,
    }
}

/// Puts one endpoint of the scene at `p`, clamped to above the plane and within reach.
pub fn set_endpoint(scene: &mut Scene, which: Endpoint, p: [f64; 3]) {
    if p.iter().any(|c| !c.is_finite()) {
        return;
    }
    let [x, y, z] = p;
    let p = [x.clamp(-FARTHEST, FARTHEST), y.clamp(-FARTHEST, FARTHEST), z.clamp(LOWEST, FARTHEST)];
    match which {
        Endpoint::Light => scene.light = p,
        Endpoint::View => scene.view = p,
    }
}

/// The projection of an endpoint onto the plane, where its handle is: of a direction, its (x, y) on the unit hemisphere.
pub fn over_plane(scene: &Scene, which: Endpoint) -> [f64; 2] {
    let p = DVec3::from(endpoint(scene, which));
    let p = if scene.kind == Kind::Distant { p.normalize() } else { p };
    [p.x, p.y]
}

/// Moves an endpoint so that its projection onto the plane is (x, y): a position keeps its height, a direction stays
/// on the hemisphere.
pub fn move_over_plane(scene: &mut Scene, which: Endpoint, [x, y]: [f64; 2]) {
    let p = match scene.kind {
        Kind::Near => [x, y, endpoint(scene, which)[2]],
        Kind::Distant => {
            let rim = (1.0 - LOWEST * LOWEST).sqrt();
            let shrink = (rim / x.hypot(y)).min(1.0);
            let [x, y] = [x * shrink, y * shrink];
            [x, y, (1.0 - x * x - y * y).max(0.0).sqrt()]
        }
    };
    set_endpoint(scene, which, p);
}

/// Multiplies the height of an endpoint by `factor`.
pub fn scale_height(scene: &mut Scene, which: Endpoint, factor: f64) {
    let [x, y, z] = endpoint(scene, which);
    set_endpoint(scene, which, [x, y, z * factor]);
}

/// Multiplies the distance of an endpoint from the middle of the material by `factor`.
pub fn scale_distance(scene: &mut Scene, which: Endpoint, factor: f64) {
    let p = endpoint(scene, which);
    set_endpoint(scene, which, p.map(|c| c * factor));
}

/// Turns an endpoint about the middle of the material: by `sideways` about the upright axis y of the screen, and by
/// `upwards` towards it, both in radians. The distance stays.
pub fn orbit(scene: &mut Scene, which: Endpoint, sideways: f64, upwards: f64) {
    const STEEPEST: f64 = std::f64::consts::FRAC_PI_2 - 1e-3;
    let p = DVec3::from(endpoint(scene, which));
    let length = p.length();
    let longitude = (p.x.atan2(p.z) + sideways).clamp(-STEEPEST, STEEPEST);
    let latitude = ((p.y / length).asin() + upwards).clamp(-STEEPEST, STEEPEST);
    let (x, y) = (latitude.cos() * longitude.sin(), latitude.sin());
    let z = (latitude.cos() * longitude.cos()).max(LOWEST / length).min(1.0);
    let shrink = ((1.0 - z * z) / (x * x + y * y).max(f64::MIN_POSITIVE)).sqrt();
    set_endpoint(scene, which, [x * shrink, y * shrink, z].map(|c| c * length));
}

/// Puts the light where a flat surface mirrors it into the view at the point (x, y) of the plane; the light keeps its
/// height. A distant light mirrored into a distant view is so at every point.
pub fn put_highlight(scene: &mut Scene, [x, y]: [f64; 2]) {
    let [view_x, view_y, view_z] = scene.view;
    let light = match scene.kind {
        Kind::Distant => [-view_x, -view_y, view_z],
        Kind::Near => {
            let reach = scene.light[2] / view_z;
            [x + (x - view_x) * reach, y + (y - view_y) * reach, scene.light[2]]
        }
    };
    set_endpoint(scene, Endpoint::Light, light);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_highlight_is_where_the_half_vector_is_the_normal() {
        let mut scene = ViewState::default().scene;
        scene.view = [0.3, -0.4, 1.7];
        let c = [0.25, 0.5];
        put_highlight(&mut scene, c);
        let at = DVec3::new(c[0], c[1], 0.0);
        let l = (DVec3::from(scene.light) - at).normalize();
        let v = (DVec3::from(scene.view) - at).normalize();
        let h = (l + v).normalize();
        assert!((h.z - 1.0).abs() < 1e-12, "{h:?}");
    }

    #[test]
    fn orbiting_keeps_the_distance_and_stays_above_the_plane() {
        let mut scene = ViewState::default().scene;
        let before = DVec3::from(scene.light).length();
        for _ in 0..100 {
            orbit(&mut scene, Endpoint::Light, 0.3, -0.2);
            assert!(scene.light[2] >= LOWEST && scene.light[0] > 0.0);
            assert!((DVec3::from(scene.light).length() - before).abs() < 1e-9);
        }
    }

    #[test]
    fn a_direction_that_is_moved_over_the_plane_stays_on_the_hemisphere() {
        let mut scene = Scene { kind: Kind::Distant, ..ViewState::default().scene };
        move_over_plane(&mut scene, Endpoint::Light, [3.0, 4.0]);
        assert!((DVec3::from(scene.light).length() - 1.0).abs() < 1e-4);
        move_over_plane(&mut scene, Endpoint::Light, [0.3, -0.2]);
        let [x, y] = over_plane(&scene, Endpoint::Light);
        assert!((x - 0.3).abs() < 1e-12 && (y + 0.2).abs() < 1e-12);
    }

    #[test]
    fn a_value_that_is_not_finite_moves_nothing() {
        let mut scene = ViewState::default().scene;
        set_endpoint(&mut scene, Endpoint::View, [f64::NAN, 0.0, 1.0]);
        assert_eq!(scene, ViewState::default().scene);
    }
}
