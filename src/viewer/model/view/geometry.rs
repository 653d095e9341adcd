//! Geometry of the window: what its last frame measured and commands depend on.

use svbrdf_core::material::Grid;
use svbrdf_core::picture::camera::Camera;

/// Sizes and places of the last frame.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct WindowGeometry {
    /// Width and height of the picture of a pane, in physical pixels; 0 before there is one.
    pub pane: [f32; 2],
    /// Width and height of the panes and the legend together, in pixels.
    pub picture: [u32; 2],
    /// Whether the side panel is closed until it is asked for.
    pub is_narrow: bool,
    /// The texel that was under the pointer last.
    pub texel: Option<[usize; 2]>,
}

impl WindowGeometry {
    /// Width of a pane over its height; 1 before there is one.
    pub fn aspect(&self) -> f32 {
        let aspect = self.pane[0] / self.pane[1];
        if aspect.is_finite() && aspect > 0.0 { aspect } else { 1.0 }
    }

    /// The magnification at which a texel of `grid` covers one physical pixel.
    pub fn one_to_one_zoom(&self, grid: Grid) -> f32 {
        let [half_width, _] = grid.half_extent();
        let fitted = Camera::flat(grid, self.pane[0] / self.pane[1]).origin_right.x;
        let pixels_per_texel = self.pane[0] * half_width / fitted / grid.width as f32;
        if pixels_per_texel.is_finite() && pixels_per_texel > 0.0 { pixels_per_texel.recip() } else { 1.0 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_to_one_covers_a_pixel_with_a_texel_in_wide_and_high_panes() {
        let grid = Grid { width: 64, height: 64 };
        for pane in [[128.0, 128.0], [256.0, 128.0], [128.0, 512.0]] {
            let geometry = WindowGeometry { pane, ..WindowGeometry::default() };
            let zoom = geometry.one_to_one_zoom(grid);
            let camera = Camera::flat(grid, geometry.aspect()).zoomed(zoom, [0.0; 2]);
            let pixel = |column: usize| {
                let ndc = camera.ndc_from_point(grid.position(column, 7)).unwrap();
                0.5 * ndc[0] * pane[0]
            };
            assert!((pixel(11) - pixel(10) - 1.0).abs() < 1e-4, "{pane:?}: {}", pixel(11) - pixel(10));
        }
        assert_eq!(WindowGeometry::default().aspect(), 1.0, "before the first frame");
    }
}
