//! Animation of light and view, and presets of the light.

use serde::{Deserialize, Serialize};

use svbrdf_core::model::scene::{Kind, Scene};

use crate::model::view::endpoint::{self, Endpoint};

/// Radians per second at speed 1: a circle takes 6 seconds.
const SPEED: f64 = std::f64::consts::TAU / 6.0;
/// Least distance from the axis, as a share of the height, of what moves around it.
const OFF_AXIS: f64 = 0.3;
/// Elevation of a grazing light, in radians.
const GRAZING: f64 = 0.18;
/// Longest step of an animation in seconds: after a pause of the window it does not jump.
const LONGEST: f64 = 0.1;

/// How the light moves, at constant height.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Path {
    /// Around the middle of the material.
    #[default]
    Circle,
    /// An eight on its side.
    FigureEight,
    /// From left to right and back.
    Sweep,
}

impl Path {
    pub const ALL: [Self; 3] = [Self::Circle, Self::FigureEight, Self::Sweep];

    pub fn name(self) -> &'static str {
        match self {
            Self::Circle => "circle",
            Self::FigureEight => "figure eight",
            Self::Sweep => "sweep",
        }
    }

    /// Where the light is at `phase` in radians, for a path as wide as `reach` from its middle to either side.
    fn at(self, phase: f64, reach: f64) -> [f64; 2] {
        let (sine, cosine) = phase.sin_cos();
        match self {
            Self::Circle => [reach * cosine, reach * sine],
            Self::FigureEight => [reach * sine, reach * sine * cosine],
            Self::Sweep => [reach * sine, 0.0],
        }
    }
}

/// What moves by itself.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Animation {
    pub path: Path,
    /// Whether the light moves.
    pub light: bool,
    /// Whether the view turns about the upright axis of the material.
    pub turntable: bool,
    /// 1 takes 6 seconds for a circle.
    pub speed: f64,
    pub paused: bool,
    phase: f64,
    /// How far the light moves from the middle.
    reach: f64,
}

impl Default for Animation {
    fn default() -> Self {
        Self {
            path: Path::Circle,
            light: false,
            turntable: false,
            speed: 1.0,
            paused: false,
            phase: 0.0,
            reach: 0.5,
        }
    }
}

impl Animation {
    /// Whether anything moves.
    pub fn is_running(&self) -> bool {
        (self.light || self.turntable) && !self.paused
    }

    /// Starts the light where it is on a circle, and other paths at their middle.
    pub fn start_light(&mut self, scene: &Scene) {
        self.light = true;
        self.paused = false;
        self.reach = radius(scene, Endpoint::Light);
        let [x, y] = endpoint::over_plane(scene, Endpoint::Light);
        self.phase = if self.path == Path::Circle { y.atan2(x) } else { 0.0 };
    }

    /// Moves light and view on by `seconds`.
    pub fn step(&mut self, scene: &mut Scene, seconds: f64) {
        if !self.is_running() {
            return;
        }
        let angle = SPEED * self.speed * seconds.clamp(0.0, LONGEST);
        if self.light {
            self.phase = (self.phase + angle) % std::f64::consts::TAU;
            let at = self.path.at(self.phase, self.reach);
            endpoint::move_over_plane(scene, Endpoint::Light, at);
        }
        if self.turntable {
            let [x, y] = endpoint::over_plane(scene, Endpoint::View);
            let radius = radius(scene, Endpoint::View);
            let (sine, cosine) = (y.atan2(x) + angle).sin_cos();
            endpoint::move_over_plane(scene, Endpoint::View, [radius * cosine, radius * sine]);
        }
    }
}

/// How far from the axis an endpoint is, and at least so far that its movement shows.
fn radius(scene: &Scene, which: Endpoint) -> f64 {
    let [x, y] = endpoint::over_plane(scene, which);
    let height = match scene.kind {
        Kind::Near => endpoint::endpoint(scene, which)[2],
        Kind::Distant => 1.0,
    };
    x.hypot(y).max(OFF_AXIS * height)
}

/// A light at the press of a button, at the distance that it has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Preset {
    /// From the left, close to the plane.
    GrazingLeft,
    /// Where the view is, as the flash of a camera.
    Flash,
    /// From the upper left, 45 degrees above the plane.
    Diagonal,
}

impl Preset {
    pub const ALL: [Self; 3] = [Self::GrazingLeft, Self::Flash, Self::Diagonal];

    /// Name and meaning.
    pub fn texts(self) -> [&'static str; 2] {
        match self {
            Self::GrazingLeft => ["Grazing left", "Light from the left, 10 degrees above the plane"],
            Self::Flash => ["Flash", "Light where the view is, as the flash of a camera"],
            Self::Diagonal => ["45 degrees", "Light from the upper left, 45 degrees above the plane"],
        }
    }

    /// Puts the light of `scene` there.
    pub fn apply(self, scene: &mut Scene) {
        let [x, y, z] = scene.light;
        let distance = (x * x + y * y + z * z).sqrt();
        let light = match self {
            Self::GrazingLeft => [-GRAZING.cos() * distance, 0.0, GRAZING.sin() * distance],
            Self::Flash => scene.view,
            Self::Diagonal => [-0.5 * distance, 0.5 * distance, 0.5_f64.sqrt() * distance],
        };
        endpoint::set_endpoint(scene, Endpoint::Light, light);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::view::state::ViewState;

    fn length(p: [f64; 3]) -> f64 {
        p.iter().map(|v| v * v).sum::<f64>().sqrt()
    }

    #[test]
    fn every_path_is_closed_and_keeps_the_height() {
        for path in Path::ALL {
            let mut scene = ViewState::default().scene;
            let mut animation = Animation { path, ..Animation::default() };
            animation.start_light(&scene);
            animation.step(&mut scene, 0.05);
            let (start, mut farthest) = (scene.light, 0.0_f64);
            for _ in 0..120 {
                animation.step(&mut scene, 0.05);
                farthest = farthest.max((scene.light[0] - start[0]).hypot(scene.light[1] - start[1]));
                assert_eq!(scene.light[2], start[2], "{path:?}");
            }
            let off = (scene.light[0] - start[0]).hypot(scene.light[1] - start[1]);
            assert!(off < 1e-9, "{path:?} ends {off} from its start after 6 seconds");
            assert!(farthest > 0.5, "{path:?} moves");
        }
    }

    #[test]
    fn a_turntable_turns_the_view_at_constant_height_and_distance() {
        let mut scene = ViewState::default().scene;
        let mut animation = Animation { turntable: true, ..Animation::default() };
        animation.step(&mut scene, 0.05);
        let first = scene.view;
        assert!(first[0].hypot(first[1]) > 0.1, "straight above would not turn: {first:?}");
        (0..60).for_each(|_| animation.step(&mut scene, 0.05));
        assert!((length(scene.view) - length(first)).abs() < 1e-9 && scene.view[2] == first[2]);
        assert!((scene.view[0] + first[0]).abs() < 1e-9, "half a turn: {:?} and {first:?}", scene.view);
        animation.paused = true;
        let paused = scene;
        animation.step(&mut scene, 0.05);
        assert_eq!(scene, paused);
    }

    #[test]
    fn presets_keep_the_distance_but_the_flash_takes_that_of_the_view() {
        let start = ViewState::default().scene;
        for preset in Preset::ALL {
            let mut scene = start;
            preset.apply(&mut scene);
            let expected = if preset == Preset::Flash { length(start.view) } else { length(start.light) };
            assert!((length(scene.light) - expected).abs() < 1e-9, "{preset:?}: {:?}", scene.light);
            assert_eq!(scene.view, start.view);
        }
    }
}
