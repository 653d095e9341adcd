//! Framing of a material: which part of it the panes show, whatever their size.

use glam::Vec3;

use svbrdf_core::material::Grid;
use svbrdf_core::picture::camera::Camera;
use svbrdf_files::session::window::Framing;

use crate::model::endpoint::{self, Endpoint};
use crate::model::view::{Projection, ViewState};

/// Least share of the material, or of the pane where the material is larger, that stays visible: of the area on the screen.
/// It is the least height of a view above the material as well, as a share of its distance, after a fit in perspective.
pub const LEAST: f64 = 0.2;
/// A visible share below which a pane says how to fit the material.
pub const NEARLY_LOST: f32 = 0.3;
/// Least and greatest magnification, as multiples of that of the fitted material.
const MAGNIFICATION: [f32; 2] = [0.1, 400.0];
/// Steps of the search for the pan that leaves enough visible.
const STEPS: usize = 16;

/// A material in panes of `pane` = [width, height] physical pixels.
#[derive(Clone, Copy, Debug)]
pub struct Framed<'a> {
    pub state: &'a ViewState,
    pub grid: Grid,
    pub pane: [f32; 2],
}

impl Framed<'_> {
    /// The part that is magnified by `factor`, where the point of the material at `at` (x right, y up in [-1, 1]) stays.
    pub fn zoomed(&self, factor: f32, at: [f32; 2]) -> Framing {
        let now = self.framing();
        let zoomed = self.at_scale(now.pixels_per_texel * factor);
        let moved = 1.0 - now.pixels_per_texel / zoomed.pixels_per_texel;
        Framing { centre: self.texel(at.map(|c| c * moved)).unwrap_or(now.centre), ..zoomed }
    }

    /// The part after the picture has moved by `by` (x right, y up, in halves of the pane).
    pub fn panned(&self, by: [f32; 2]) -> Framing {
        let now = self.framing();
        Framing { centre: self.texel(by.map(|c| -c)).unwrap_or(now.centre), ..now }
    }

    /// The part at a magnification, around the same point.
    pub fn at_scale(&self, pixels_per_texel: f32) -> Framing {
        let fitted = self.fitted();
        let [least, most] = MAGNIFICATION.map(|factor| factor * fitted.pixels_per_texel);
        Framing { pixels_per_texel: pixels_per_texel.clamp(least, most.max(1.0)), ..self.framing() }
    }

    fn framing(&self) -> Framing {
        self.state.display.framing.unwrap_or_else(|| self.fitted())
    }

    fn fitted(&self) -> Framing {
        let camera = self.state.fitted_camera(self.grid, aspect(self.pane));
        Framing {
            pixels_per_texel: pixels_per_texel(&camera, self.grid, self.pane),
            centre: middle(self.grid),
        }
    }

    /// The point at (x, y) of the pane, in texels.
    fn texel(&self, [x, y]: [f32; 2]) -> Option<[f32; 2]> {
        let point = self.state.camera(self.grid, self.pane).plane_from_ndc(x, y)?;
        Some(self.grid.place(point))
    }
}

impl ViewState {
    /// Fits the material into its pane. In perspective a view that sees it as a line is raised, too.
    pub fn fit(&mut self) {
        self.display.framing = None;
        if self.display.projection == Projection::Perspective {
            endpoint::raise(&mut self.scene, Endpoint::View, LEAST);
        }
    }

    /// The camera of a pane of `pane` = [width, height] physical pixels.
    pub fn camera(&self, grid: Grid, pane: [f32; 2]) -> Camera {
        let fitted = self.fitted_camera(grid, aspect(pane));
        let Some(framing) = self.display.framing else { return fitted };
        let zoom = framing.pixels_per_texel / pixels_per_texel(&fitted, grid, pane);
        let [x, y] = grid.point(framing.centre);
        let centre = fitted.ndc_from_point(Vec3::new(x, y, 0.0));
        match centre {
            Some(centre) if zoom.is_finite() && zoom > 0.0 => fitted.zoomed(zoom, centre.map(|c| -c * zoom)),
            _ => fitted,
        }
    }
}

/// The framing of `state`, moved towards the middle of the material as far as it takes to leave a fifth of it visible.
pub fn limited(state: &ViewState, grid: Grid, pane: [f32; 2]) -> Option<Framing> {
    let framing = state.display.framing?;
    let (size, middle) = (size(grid), middle(grid));
    let edge: [f32; 2] = std::array::from_fn(|axis| framing.centre[axis].clamp(0.0, size[axis]));
    let inwards = |share: f32| Framing {
        centre: std::array::from_fn(|axis| edge[axis] + share * (middle[axis] - edge[axis])),
        ..framing
    };
    let mut state = state.clone();
    let mut is_enough = |share: f32| {
        state.display.framing = Some(inwards(share));
        f64::from(visible_share(&state, grid, pane)) >= LEAST
    };
    if is_enough(0.0) {
        return Some(inwards(0.0));
    }
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..STEPS {
        let between = 0.5 * (low + high);
        if is_enough(between) { high = between } else { low = between }
    }
    Some(inwards(high))
}

/// The visible share of the material, or of the pane where the material is larger: of the area on the screen.
pub fn visible_share(state: &ViewState, grid: Grid, pane: [f32; 2]) -> f32 {
    let camera = state.camera(grid, pane);
    let [x, y] = grid.half_extent();
    let corners = [[-x, -y], [x, -y], [x, y], [-x, y]];
    let corners: Option<Vec<[f32; 2]>> =
        corners.iter().map(|[x, y]| camera.ndc_from_point(Vec3::new(*x, *y, 0.0))).collect();
    // A corner behind the view: the material fills the pane.
    let Some(corners) = corners else { return 1.0 };
    let all = area(&corners).min(4.0);
    if all > 0.0 { area(&in_pane(corners)) / all } else { 1.0 }
}

/// The part of a convex polygon inside a pane's [-1, 1] along both axes (Sutherland and Hodgman 1974).
fn in_pane(mut polygon: Vec<[f32; 2]>) -> Vec<[f32; 2]> {
    for (axis, sign) in [(0, 1.0), (0, -1.0), (1, 1.0), (1, -1.0)] {
        let inside = |p: &[f32; 2]| 1.0 - sign * p[axis];
        let ends = polygon.iter().zip(polygon.iter().cycle().skip(1));
        polygon = ends
            .flat_map(|(a, b)| {
                let (from, to) = (inside(a), inside(b));
                let t = from / (from - to);
                let crossing: [f32; 2] = std::array::from_fn(|i| a[i] + t * (b[i] - a[i]));
                let crosses = (from >= 0.0) != (to >= 0.0);
                (from >= 0.0).then_some(*a).into_iter().chain(crosses.then_some(crossing))
            })
            .collect();
    }
    polygon
}

fn area(polygon: &[[f32; 2]]) -> f32 {
    let ends = polygon.iter().zip(polygon.iter().cycle().skip(1));
    ends.map(|(a, b)| a[0] * b[1] - a[1] * b[0]).sum::<f32>().abs() * 0.5
}

/// Width over height; 1 before there is a pane.
fn aspect([width, height]: [f32; 2]) -> f32 {
    let aspect = width / height;
    if aspect.is_finite() && aspect > 0.0 { aspect } else { 1.0 }
}

/// Physical pixels per texel of a camera that fits the material into its pane.
fn pixels_per_texel(fitted: &Camera, grid: Grid, pane: [f32; 2]) -> f32 {
    let texel = 2.0 * grid.half_extent()[1] / grid.height as f32;
    let pixels = 0.5 * pane[1] / fitted.half_height() * texel;
    if pixels.is_finite() && pixels > 0.0 { pixels } else { 1.0 }
}

fn middle(grid: Grid) -> [f32; 2] {
    size(grid).map(|side| 0.5 * side)
}

fn size(grid: Grid) -> [f32; 2] {
    [grid.width as f32, grid.height as f32]
}

#[cfg(test)]
mod tests {
    use super::*;
    use svbrdf_files::session::window::SessionDisplay;

    const GRID: Grid = Grid { width: 64, height: 48 };
    const PANE: [f32; 2] = [640.0, 500.0];
    const PROJECTIONS: [Projection; 2] = [Projection::Flat, Projection::Perspective];

    fn state(projection: Projection, framing: Option<Framing>) -> ViewState {
        let mut state = ViewState::default();
        state.scene.view = [0.5, -0.3, 2.0];
        state.display = SessionDisplay { projection, framing, ..SessionDisplay::default() };
        state
    }

    fn framed(state: &ViewState, pane: [f32; 2]) -> Framed<'_> {
        Framed { state, grid: GRID, pane }
    }

    #[test]
    fn one_to_one_covers_a_pixel_with_a_texel_in_wide_and_high_panes() {
        for pane in [[128.0, 128.0], [256.0, 128.0], [128.0, 512.0]] {
            let mut state = state(Projection::Flat, None);
            state.display.framing = Some(framed(&state, pane).at_scale(1.0));
            let camera = state.camera(GRID, pane);
            let pixel = |column| 0.5 * camera.ndc_from_point(GRID.position(column, 7)).unwrap()[0] * pane[0];
            assert!((pixel(11) - pixel(10) - 1.0).abs() < 1e-4, "{pane:?}: {}", pixel(11) - pixel(10));
        }
        assert_eq!(
            state(Projection::Flat, None).camera(GRID, [0.0; 2]),
            Camera::flat(GRID, 1.0),
            "no pane yet"
        );
    }

    #[test]
    fn a_framing_shows_the_same_texel_at_the_same_size_in_every_pane() {
        let framing = Framing { pixels_per_texel: 12.0, centre: [50.5, 9.5] };
        for projection in PROJECTIONS {
            let state = state(projection, Some(framing));
            let at = |pane: [f32; 2], x: f32, y: f32| {
                framed(&state, pane).texel([2.0 * x / pane[0], 2.0 * y / pane[1]]).unwrap()
            };
            for pane in [PANE, [300.0, 900.0], [1200.0, 200.0]] {
                for (x, y) in [(0.0, 0.0), (40.0, -25.0)] {
                    let (here, there) = (at(PANE, x, y), at(pane, x, y));
                    let off = (here[0] - there[0]).abs().max((here[1] - there[1]).abs());
                    assert!(off < 2e-2, "{projection:?} {pane:?}: {here:?} became {there:?}");
                }
                let centre = at(pane, 0.0, 0.0);
                assert!((centre[0] - 50.5).abs() < 1e-2 && (centre[1] - 9.5).abs() < 1e-2, "{centre:?}");
            }
        }
    }

    #[test]
    fn zooming_keeps_the_point_under_the_pointer_and_panning_moves_it_with_the_pointer() {
        for projection in PROJECTIONS {
            let mut state = state(projection, Some(Framing { pixels_per_texel: 20.0, centre: [30.0, 20.0] }));
            let at = [0.5, 0.1];
            let before = framed(&state, PANE).texel(at).unwrap();
            state.display.framing = Some(framed(&state, PANE).zoomed(2.5, at));
            let after = framed(&state, PANE).texel(at).unwrap();
            assert!((before[0] - after[0]).abs() < 1e-2 && (before[1] - after[1]).abs() < 1e-2);
            let grabbed = framed(&state, PANE).texel([0.0, 0.0]).unwrap();
            state.display.framing = Some(framed(&state, PANE).panned([0.2, -0.1]));
            let moved = framed(&state, PANE).texel([0.2, -0.1]).unwrap();
            let off = (grabbed[0] - moved[0]).abs().max((grabbed[1] - moved[1]).abs());
            // In perspective the texels change their size on the way.
            assert!(off < if projection == Projection::Flat { 1e-2 } else { 0.5 }, "{grabbed:?} {moved:?}");
        }
    }

    #[test]
    fn a_fifth_stays_visible_at_every_magnification_and_projection() {
        for projection in PROJECTIONS {
            for pixels_per_texel in [1.0, 5.0, 10.0, 70.0, 4000.0] {
                for far in [[1e4, 0.0], [0.0, -1e4], [1e4, 1e4], [-1e4, 30.0]] {
                    let mut state = state(projection, Some(Framing { pixels_per_texel, centre: far }));
                    let lost = visible_share(&state, GRID, PANE);
                    assert!(lost < NEARLY_LOST || projection == Projection::Perspective, "a planted fault");
                    state.display.framing = limited(&state, GRID, PANE);
                    let share = visible_share(&state, GRID, PANE);
                    assert!(share > 0.199, "{share} visible of {state:?}");
                }
            }
        }
    }

    #[test]
    fn a_framing_that_leaves_enough_visible_stays() {
        for centre in [[0.5, 0.5], [60.0, 3.0], [30.0, 47.0]] {
            let framing = Some(Framing { pixels_per_texel: 30.0, centre });
            assert_eq!(limited(&state(Projection::Flat, framing), GRID, PANE), framing);
        }
        assert_eq!(limited(&state(Projection::Flat, None), GRID, PANE), None);
    }
}
