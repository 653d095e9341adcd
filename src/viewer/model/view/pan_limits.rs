//! Limits of panning: they keep a part of the material visible.

use glam::Vec3;

use svbrdf_core::material::Grid;

use crate::viewer::model::view::state::ViewState;

/// Least part of the material, or of the pane where the material is larger, that panning leaves visible along each axis:
/// a fifth of the area along both.
const LEAST: f32 = 0.447_213_6;
/// A visible part below which a pane says how to fit the material.
pub const NEARLY_LOST: f32 = 0.3;
/// The pan nearest to that of `state` which leaves a fifth of the material visible.
pub fn limited(state: &ViewState, grid: Grid, aspect: f32) -> [f32; 2] {
    let Some(extents) = extents(state, grid, aspect) else { return state.display.pan };
    std::array::from_fn(|axis| {
        let [low, high] = extents[axis];
        let least = LEAST * (high - low).min(2.0);
        // At pan p the material covers [low + p, high + p] of the pane's [-1, 1].
        state.display.pan[axis].clamp(least - 1.0 - high, 1.0 - least - low)
    })
}

/// The visible share of the material, or of the pane where the material is larger.
pub fn visible_share(state: &ViewState, grid: Grid, aspect: f32) -> f32 {
    let Some(extents) = extents(state, grid, aspect) else { return 1.0 };
    let share = |axis: usize| {
        let [low, high] = extents[axis].map(|end| end + state.display.pan[axis]);
        ((high.min(1.0) - low.max(-1.0)) / (high - low).min(2.0)).max(0.0)
    };
    share(0) * share(1)
}

/// From where to where the magnified material reaches along each axis of the pane, before panning; `None` where a corner
/// is behind the view.
fn extents(state: &ViewState, grid: Grid, aspect: f32) -> Option<[[f32; 2]; 2]> {
    let camera = state.fitted_camera(grid, aspect);
    let [x, y] = grid.half_extent();
    let mut all = [[f32::INFINITY, f32::NEG_INFINITY]; 2];
    for corner in [[-x, -y], [x, -y], [-x, y], [x, y]] {
        let projected = camera.ndc_from_point(Vec3::new(corner[0], corner[1], 0.0))?;
        for (extent, at) in all.iter_mut().zip(projected) {
            *extent = [extent[0].min(at * state.display.zoom), extent[1].max(at * state.display.zoom)];
        }
    }
    Some(all)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::viewer::model::view::state::Projection;
    use svbrdf_files::session_window::Display;

    const GRID: Grid = Grid { width: 64, height: 48 };

    #[test]
    fn the_material_stays_visible_at_every_zoom_and_projection() {
        for projection in [Projection::Flat, Projection::Perspective] {
            for zoom in [0.1, 0.5, 1.0, 7.0, 400.0] {
                for far in [[1e4, 0.0], [0.0, -1e4], [1e4, 1e4], [-1e4, 30.0]] {
                    let mut state = ViewState {
                        display: Display { projection, zoom, pan: far, ..Display::default() },
                        ..ViewState::default()
                    };
                    assert!(visible_share(&state, GRID, 1.3) < NEARLY_LOST, "a planted fault");
                    state.display.pan = limited(&state, GRID, 1.3);
                    let share = visible_share(&state, GRID, 1.3);
                    assert!(share > 0.199, "{share} visible of {state:?}");
                }
            }
        }
    }

    #[test]
    fn a_pan_that_leaves_enough_visible_stays() {
        for pan in [[0.0, 0.0], [0.9, -0.4], [-0.5, 0.9]] {
            let state = ViewState {
                display: Display { zoom: 3.0, pan, ..Display::default() },
                ..ViewState::default()
            };
            assert_eq!(limited(&state, GRID, 1.0), pan);
        }
    }
}
