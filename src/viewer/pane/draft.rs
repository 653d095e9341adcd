//! Drafts: how much of the materials is shaded while something moves; less on an adapter that computes on the CPU, everything after a
//! pause.

use svbrdf_core::material::Grid;
use svbrdf_core::picture::camera::Camera;
use svbrdf_files::session::window::Framing;
use svbrdf_gpu::ShadeParams;

use crate::model::inspection::Region;
use crate::model::view::ViewState;
use crate::pane::shaded::ShadedPart;

/// Texels of all materials that software shades within a frame.
pub const LARGE: usize = 1 << 19;
/// Seconds without movement after which everything is shaded.
pub const PAUSE: f64 = 0.15;

/// What moves: the scene, or the section of the material that is seen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PaneView {
    pub params: ShadeParams,
    pub framing: Option<Framing>,
}

/// When something moved last.
#[derive(Debug, Default)]
pub struct DraftPolicy {
    last: Option<PaneView>,
    changed: Option<f64>,
}

impl DraftPolicy {
    /// Whether something moves in a frame at `now`, or has moved a moment ago.
    pub fn moves(&mut self, visible: PaneView, now: f64) -> bool {
        if self.last.replace(visible).is_some_and(|last| last != visible) {
            self.changed = Some(now);
        }
        self.changed.is_some_and(|changed| now - changed < PAUSE)
    }
}

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

    use svbrdf_core::model::convention::PRINTED;
    use svbrdf_core::picture::quantity::Quantity;
    use svbrdf_files::session::window::SessionDisplay;

    use crate::model::view::Projection;

    #[test]
    fn a_light_or_a_section_that_changes_moves_until_a_pause() {
        let scene = ViewState::default().scene;
        let params = ShadeParams { scene, convention: PRINTED, quantity: Quantity::Rendering };
        let still = PaneView { params, framing: None };
        let mut lit = still;
        lit.params.scene.light[0] = 0.7;
        let framing = Some(Framing { pixels_per_texel: 1.15, centre: [2.0; 2] });
        for next in [lit, PaneView { framing, ..still }] {
            let mut policy = DraftPolicy::default();
            assert!(!policy.moves(still, 0.0) && !policy.moves(still, 1.0));
            assert!(policy.moves(next, 2.0) && policy.moves(next, 2.1), "it may go on");
            assert!(!policy.moves(next, 2.11 + PAUSE), "at rest");
        }
    }

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
