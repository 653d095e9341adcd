//! Visible part of a material: what is shaded while something moves on a slow adapter.

use svbrdf_core::material::Grid;
use svbrdf_core::picture::camera::Camera;

use crate::model::inspection::Region;
use crate::model::view::ViewState;
use crate::pane::shaded::ShadedPart;

/// Most texels along an axis that one stands for.
const MOST: usize = 64;
/// How far around a pane texels are shaded, as a share of it: those at its edge are averaged with their neighbours.
const AROUND: f32 = 0.04;

/// About one texel a pixel where several fall into one, the visible texels otherwise. `pixels_per_texel` is the magnification in panes of `pane` = [width, height] physical pixels.
pub fn shaded_part(state: &ViewState, grid: Grid, pane: [f32; 2], pixels_per_texel: f32) -> ShadedPart {
    let stride = (pixels_per_texel.recip().round() as usize).clamp(1, MOST);
    if stride > 1 {
        return ShadedPart::EveryNth(stride);
    }
    let all = [grid.width, grid.height];
    let region = visible(&state.camera(grid, pane), grid).filter(|region| region.size() != all);
    region.map_or(ShadedPart::Whole, ShadedPart::Visible)
}

/// The texels in a pane; `None` where its corners do not show the plane, or nothing of the material is in it.
fn visible(camera: &Camera, grid: Grid) -> Option<Region> {
    let far = 1.0 + AROUND;
    let corners = [(-far, -far), (far, -far), (-far, far), (far, far)];
    let (mut low, mut high) = ([f32::INFINITY; 2], [f32::NEG_INFINITY; 2]);
    for (x, y) in corners {
        let point = camera.plane_from_ndc(x, y)?;
        for axis in 0..2 {
            low[axis] = low[axis].min(point[axis]);
            high[axis] = high[axis].max(point[axis]);
        }
    }
    Region::between(grid, low, high)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::view::Projection;
    use svbrdf_files::session::window::{Framing, SessionDisplay};

    const GRID: Grid = Grid { width: 256, height: 128 };
    const PANE: [f32; 2] = [600.0, 400.0];

    /// Every texel that a ray of a pane meets.
    fn visible_texels(state: &ViewState) -> Vec<[usize; 2]> {
        let camera = state.camera(GRID, PANE);
        let steps = || (0..=60).map(|i| i as f32 / 30.0 - 1.0);
        let rays = steps().flat_map(|x| steps().map(move |y| (x, y)));
        rays.filter_map(|(x, y)| GRID.texel_at(camera.plane_from_ndc(x, y)?)).collect()
    }

    #[test]
    fn all_that_is_visible_is_shaded_and_little_else() {
        let cases = [(1.0, None), (4.0, Some([118.0, 58.0])), (16.0, Some([144.0, 74.0]))];
        let projections = [Projection::Flat, Projection::Perspective];
        let cases = projections.into_iter().flat_map(|projection| cases.map(|case| (projection, case)));
        for (projection, (zoom, centre)) in cases {
            // Fitted, a texel covers about 2.3 pixels.
            let framing = centre.map(|centre| Framing { pixels_per_texel: 2.3 * zoom, centre });
            let display = SessionDisplay { projection, framing, ..SessionDisplay::default() };
            let mut state = ViewState { display, ..ViewState::default() };
            state.scene.view = [0.7, -0.4, 2.0];
            let what = format!("{projection:?} {zoom}");
            let part = shaded_part(&state, GRID, PANE, 2.0);
            let texels = visible_texels(&state);
            assert!(!texels.is_empty(), "{what}");
            let all = [GRID.width, GRID.height];
            let region = match part {
                ShadedPart::Visible(region) => region,
                ShadedPart::Whole if zoom == 1.0 => Region { first: [0; 2], last: all.map(|side| side - 1) },
                _ => panic!("{what}: {part:?}"),
            };
            let is_in = |[x, y]: &[usize; 2]| {
                let ([left, top], [right, bottom]) = (region.first, region.last);
                (left..=right).contains(x) && (top..=bottom).contains(y)
            };
            assert!(texels.iter().all(is_in), "{what}: {region:?}");
            let [columns, rows] = region.size();
            let share = (columns * rows) as f32 / (all[0] * all[1]) as f32;
            assert!(share < 4.0 / (zoom * zoom) + 0.05, "{what}: {share}");
        }
    }

    #[test]
    fn minified_materials_have_about_a_texel_a_pixel() {
        let part = |magnification| shaded_part(&ViewState::default(), GRID, PANE, magnification);
        assert_eq!(part(0.3), ShadedPart::EveryNth(3));
        assert_eq!(part(0.252), ShadedPart::EveryNth(4));
        assert_eq!(part(1e-9), ShadedPart::EveryNth(MOST));
    }
}
