//! What the panes show and how: everything that Ctrl+Z undoes.

use serde::{Deserialize, Serialize};

use crate::math::vec3::Vec3;
use crate::model::convention::{self, Convention};
use crate::model::scene::{Kind, Scene};
use crate::picture::content::Shown;

/// Lowest height of a light or a view that the window lets a person set: the plane itself shows nothing.
pub const LOWEST: f64 = 0.01;
/// Farthest coordinate that the window lets a person set.
pub const FARTHEST: f64 = 1000.0;

/// How the panes are arranged.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Layout {
    /// The ground truth and every prediction, each in a pane of its own.
    #[default]
    SideBySide,
    /// Ground truth and chosen prediction in one pane, left and right of a line.
    Wipe,
    /// The chosen prediction alone.
    Single,
    /// |ln(prediction + epsilon) - ln(ground truth + epsilon)|, what the loss is the mean of.
    Difference,
}

impl Layout {
    pub const ALL: [Self; 4] = [Self::SideBySide, Self::Wipe, Self::Single, Self::Difference];

    pub fn name(self) -> &'static str {
        match self {
            Self::SideBySide => "side by side",
            Self::Wipe => "wipe",
            Self::Single => "single",
            Self::Difference => "log difference",
        }
    }
}

/// How the material lies in a pane.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Projection {
    /// As a texture, the way the loss sees it.
    #[default]
    Flat,
    /// As the plane that it is, seen from P_V.
    Perspective,
}

/// What the key that toggles the projection leads to.
pub fn other_projection(projection: Projection) -> Projection {
    match projection {
        Projection::Flat => Projection::Perspective,
        Projection::Perspective => Projection::Flat,
    }
}

/// Light, view and display: one value, so that undo is to go back to an earlier one.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ViewState {
    pub scene: Scene,
    pub shown: Shown,
    pub layout: Layout,
    pub projection: Projection,
    /// Exposure in stops: radiance is multiplied by 2^exposure_ev.
    pub exposure_ev: f32,
    pub show_clipping: bool,
    /// Where the wipe line stands: 0 at the left edge of the pane, 1 at the right.
    pub wipe: f32,
    /// Magnification; 1 fits the material into its pane.
    pub zoom: f32,
    /// Where the middle of the unmoved picture stands in its pane, x right and y up in [-1, 1].
    pub pan: [f32; 2],
    /// The name of the convention that is rendered and that the loss is computed in.
    pub convention: String,
    /// Which prediction is compared where one is: its index among the predictions.
    pub prediction: usize,
}

impl Default for ViewState {
    fn default() -> Self {
        Self {
            scene: Scene { kind: Kind::Near, view: [0.0, 0.0, 2.5], light: [0.4, 0.5, 1.2] },
            shown: Shown::Rendering,
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
    /// The convention named; the default where a stored name is no longer known.
    pub fn convention(&self) -> Convention {
        self.convention.parse().unwrap_or_default()
    }

    /// Puts back the light, the view and the display, but not which prediction, layout or convention is looked at.
    #[must_use]
    pub fn reset(&self) -> Self {
        Self {
            layout: self.layout,
            shown: self.shown,
            projection: self.projection,
            convention: self.convention.clone(),
            prediction: self.prediction,
            ..Self::default()
        }
    }
}

/// Either end of a scene: what a gesture moves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum End {
    Light,
    View,
}

/// The position (or direction) of one end of the scene.
pub fn end(scene: &Scene, end: End) -> [f64; 3] {
    match end {
        End::Light => scene.light,
        End::View => scene.view,
    }
}

/// Puts one end of the scene at `p`, kept above the plane and within reach.
pub fn set_end(scene: &mut Scene, end: End, p: [f64; 3]) {
    if p.iter().any(|c| !c.is_finite()) {
        return;
    }
    let [x, y, z] = p;
    let p = [x.clamp(-FARTHEST, FARTHEST), y.clamp(-FARTHEST, FARTHEST), z.clamp(LOWEST, FARTHEST)];
    match end {
        End::Light => scene.light = p,
        End::View => scene.view = p,
    }
}

/// Where the handle of an end lies in the plane: below a position; for a direction, its (x, y) on the unit hemisphere.
pub fn foot(scene: &Scene, which: End) -> [f64; 2] {
    let p = Vec3::from(end(scene, which));
    let p = if scene.kind == Kind::Distant { p.normalize() } else { p };
    [p.x, p.y]
}

/// Moves an end so that its foot is at (x, y): a position keeps its height, a direction stays on the hemisphere.
pub fn set_foot(scene: &mut Scene, which: End, [x, y]: [f64; 2]) {
    let p = match scene.kind {
        Kind::Near => [x, y, end(scene, which)[2]],
        Kind::Distant => {
            let rim = (1.0 - LOWEST * LOWEST).sqrt();
            let shrink = (rim / x.hypot(y)).min(1.0);
            let [x, y] = [x * shrink, y * shrink];
            [x, y, (1.0 - x * x - y * y).max(0.0).sqrt()]
        }
    };
    set_end(scene, which, p);
}

/// Multiplies the height of an end by `factor`.
pub fn scale_height(scene: &mut Scene, which: End, factor: f64) {
    let [x, y, z] = end(scene, which);
    set_end(scene, which, [x, y, z * factor]);
}

/// Multiplies the distance of an end from the middle of the material by `factor`.
pub fn scale_distance(scene: &mut Scene, which: End, factor: f64) {
    let p = end(scene, which);
    set_end(scene, which, p.map(|c| c * factor));
}

/// Turns an end about the middle of the material, which hangs like a picture on a wall: by `sideways` about the
/// upright axis y, and by `upwards` towards it, both in radians. The distance stays, and so does what is up on the screen.
pub fn orbit(scene: &mut Scene, which: End, sideways: f64, upwards: f64) {
    const STEEPEST: f64 = std::f64::consts::FRAC_PI_2 - 1e-3;
    let p = Vec3::from(end(scene, which));
    let length = p.length();
    let longitude = (p.x.atan2(p.z) + sideways).clamp(-STEEPEST, STEEPEST);
    let latitude = ((p.y / length).asin() + upwards).clamp(-STEEPEST, STEEPEST);
    let (x, y) = (latitude.cos() * longitude.sin(), latitude.sin());
    let z = (latitude.cos() * longitude.cos()).max(LOWEST / length).min(1.0);
    let shrink = ((1.0 - z * z) / (x * x + y * y).max(f64::MIN_POSITIVE)).sqrt();
    set_end(scene, which, [x * shrink, y * shrink, z].map(|c| c * length));
}

/// Puts the light where the flat surface mirrors it into the view at the point (x, y) of the plane, at the height that
/// it has. From a distant view the highlight is everywhere, wherever the point is.
pub fn put_highlight(scene: &mut Scene, [x, y]: [f64; 2]) {
    let [view_x, view_y, view_z] = scene.view;
    let light = match scene.kind {
        Kind::Distant => [-view_x, -view_y, view_z],
        Kind::Near => {
            let reach = scene.light[2] / view_z;
            [x + (x - view_x) * reach, y + (y - view_y) * reach, scene.light[2]]
        }
    };
    set_end(scene, End::Light, light);
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
        let at = Vec3::new(c[0], c[1], 0.0);
        let l = (Vec3::from(scene.light) - at).normalize();
        let v = (Vec3::from(scene.view) - at).normalize();
        let h = (l + v).normalize();
        assert!((h.z - 1.0).abs() < 1e-12, "{h:?}");
    }

    #[test]
    fn orbiting_keeps_the_distance_and_stays_above_the_plane() {
        let mut scene = ViewState::default().scene;
        let before = Vec3::from(scene.light).length();
        for _ in 0..100 {
            orbit(&mut scene, End::Light, 0.3, -0.2);
            assert!(scene.light[2] >= LOWEST && scene.light[0] > 0.0);
            assert!((Vec3::from(scene.light).length() - before).abs() < 1e-9);
        }
    }

    #[test]
    fn the_foot_of_a_direction_stays_on_the_hemisphere() {
        let mut scene = Scene { kind: Kind::Distant, ..ViewState::default().scene };
        set_foot(&mut scene, End::Light, [3.0, 4.0]);
        assert!((Vec3::from(scene.light).length() - 1.0).abs() < 1e-4);
        set_foot(&mut scene, End::Light, [0.3, -0.2]);
        let [x, y] = foot(&scene, End::Light);
        assert!((x - 0.3).abs() < 1e-12 && (y + 0.2).abs() < 1e-12);
    }

    #[test]
    fn a_value_that_is_not_finite_moves_nothing() {
        let mut scene = ViewState::default().scene;
        set_end(&mut scene, End::View, [f64::NAN, 0.0, 1.0]);
        assert_eq!(scene, ViewState::default().scene);
    }
}
