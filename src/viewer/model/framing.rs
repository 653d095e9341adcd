//! Framing of a material: which part of it the panes show, whatever their size.

use glam::Vec3;

use svbrdf_core::material::Grid;
use svbrdf_core::picture::camera::Camera;
use svbrdf_files::session::window::Framing;

use crate::model::endpoint::{self, Endpoint};
use crate::model::view::{Projection, ViewState};

/// Least height of a view above the material after a fit in perspective, as a share of its distance.
const LEAST: f64 = 0.2;
/// Least and greatest magnification, as multiples of that of the fitted material.
const MAGNIFICATION: [f32; 2] = [0.1, 400.0];

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

    /// Pans so far back that the middle of the pane is on the material.
    pub fn keep_visible(&mut self, grid: Grid) {
        if let Some(framing) = &mut self.display.framing {
            let size = size(grid);
            framing.centre = std::array::from_fn(|axis| framing.centre[axis].clamp(0.0, size[axis]));
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
    fn the_middle_of_the_pane_stays_on_the_material() {
        for (far, near) in [([1e4, 0.0], [64.0, 0.0]), ([0.0, -1e4], [0.0; 2]), ([60.0, 3.0], [60.0, 3.0])] {
            let mut state = state(Projection::Flat, Some(Framing { pixels_per_texel: 30.0, centre: far }));
            state.keep_visible(GRID);
            assert_eq!(state.display.framing.unwrap().centre, near);
        }
    }
}
