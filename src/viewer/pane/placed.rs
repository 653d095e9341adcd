//! A pane's picture on the screen: the one mapping between the screen, the plane and its texels.

use eframe::egui::{Pos2, Rect};
use glam::Vec3;

use svbrdf_core::material::Grid;
use svbrdf_core::picture::camera::Camera;

use crate::model::inspection::Region;
use crate::pane::handles::{ndc_from_pos, pos_from_ndc};

/// A pane's picture on the screen.
#[derive(Clone, Copy, Debug)]
pub struct Placed {
    pub rect: Rect,
    pub camera: Camera,
    pub grid: Grid,
}

impl Placed {
    /// The point of the plane that is seen at `pos`.
    pub fn point(&self, pos: Pos2) -> Option<[f32; 2]> {
        let [x, y] = ndc_from_pos(self.rect, pos);
        self.camera.plane_from_ndc(x, y)
    }

    /// The texel that is seen at `pos`.
    pub fn texel(&self, pos: Pos2) -> Option<[usize; 2]> {
        self.grid.texel_at(self.point(pos)?)
    }

    /// Where a place is, in texels.
    pub fn pos(&self, place: [f32; 2]) -> Option<Pos2> {
        let [x, y] = self.grid.point(place);
        self.camera.ndc_from_point(Vec3::new(x, y, 0.0)).map(|ndc| pos_from_ndc(self.rect, ndc))
    }

    pub fn outline(&self, region: Region) -> Option<Vec<Pos2>> {
        let [[left, top], [right, bottom]] = region.edges();
        [[left, top], [right, top], [right, bottom], [left, bottom]]
            .into_iter()
            .map(|place| self.pos(place))
            .collect()
    }

    /// The side of the texel at a place, in points: the shorter one where perspective distorts it.
    pub fn side(&self, place: [f32; 2]) -> f32 {
        let [column, row] = place.map(f32::floor);
        let corners = [[column, row], [column + 1.0, row], [column, row + 1.0]];
        let [Some(a), Some(b), Some(c)] = corners.map(|place| self.pos(place)) else { return 0.0 };
        a.distance(b).min(a.distance(c))
    }

    /// The side of a texel in the middle of the pane, in points.
    pub fn side_in_the_middle(&self) -> f32 {
        let middle = self.camera.plane_from_ndc(0.0, 0.0).unwrap_or_default();
        self.side(self.grid.place(middle))
    }

    /// The visible texels of a flat view.
    pub fn visible(&self) -> Option<Region> {
        let corner = |[x, y]: [f32; 2]| self.camera.plane_from_ndc(x, y);
        Region::between(self.grid, corner([-1.0, 1.0])?, corner([1.0, -1.0])?)
    }
}
