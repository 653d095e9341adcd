//! Places of the panes: their arrangement, and the one mapping between the screen, the plane and its texels.

use eframe::egui::{self, Pos2, Rect, Vec2, vec2};
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

/// Height of the title above a pane.
pub const TITLE: f32 = 24.0;
/// Room between two panes.
const GAP: f32 = 6.0;

/// The number of columns of `count` cells that shows the material largest in `area`.
pub fn columns(area: Rect, count: usize, grid: Grid) -> usize {
    let [half_width, half_height] = grid.half_extent();
    let size = |columns: usize| {
        let cell = cell_size(area.size(), columns, count.div_ceil(columns));
        (cell.x / half_width).min((cell.y - TITLE) / half_height)
    };
    (1..=count.max(1)).max_by(|a, b| size(*a).total_cmp(&size(*b))).unwrap_or(1)
}

/// Splits `area` into `count` cells. All have the same size in whole pixels (`scale` pixels per point): only then are
/// equal pictures equal pixel by pixel.
pub fn cells(area: Rect, count: usize, columns: usize, scale: f32) -> Vec<Rect> {
    let whole = |v: Vec2| (v * scale).floor() / scale;
    let area = Rect::from_min_max(((area.min.to_vec2() * scale).ceil() / scale).to_pos2(), area.max);
    let cell = whole(cell_size(area.size(), columns, count.div_ceil(columns)));
    let step = cell + whole(Vec2::splat(GAP));
    (0..count)
        .map(|i| {
            let place = vec2((i % columns) as f32, (i / columns) as f32);
            Rect::from_min_size(area.min + place * step, cell)
        })
        .collect()
}

fn cell_size(area: Vec2, columns: usize, rows: usize) -> Vec2 {
    let gaps = vec2(columns as f32 - 1.0, rows as f32 - 1.0) * GAP;
    ((area - gaps) / vec2(columns as f32, rows as f32)).max(Vec2::splat(TITLE + 8.0))
}

/// The rectangle of a pane's picture: its cell without the title, in whole physical pixels, so that the shader's pixels are the screen's.
/// Their number along each side is even: the middle of no pixel is on the edge between the two texels in the middle.
pub fn picture_rect(ui: &egui::Ui, cell: Rect) -> Rect {
    let scale = ui.pixels_per_point();
    let below = cell.split_top_bottom_at_y(cell.top() + TITLE).1;
    let [min, max] = [below.min, below.max].map(|p| (p.to_vec2() * scale).round());
    let size = ((max - min) / 2.0).floor() * 2.0;
    Rect::from_min_size((min / scale).to_pos2(), size / scale)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn arranged(area: Rect, count: usize, scale: f32) -> Vec<Rect> {
        cells(area, count, columns(area, count, SQUARE), scale)
    }

    const SQUARE: Grid = Grid { width: 256, height: 256 };

    fn area(width: f32, height: f32) -> Rect {
        Rect::from_min_size(egui::pos2(10.0, 20.0), vec2(width, height))
    }

    #[test]
    fn cells_lie_inside_the_area_and_apart() {
        for (count, size) in
            [(1, (800.0, 600.0)), (3, (1000.0, 300.0)), (5, (700.0, 900.0)), (9, (640.0, 480.0))]
        {
            let area = area(size.0, size.1);
            let cells = arranged(area, count, 1.5);
            let off = |cell: &Rect| (cell.size() - cells[0].size()).length();
            assert!(cells.iter().all(|cell| off(cell) < 1e-3), "{cells:?}");
            let pixels = cells.iter().flat_map(|cell| [cell.min, cell.max]).map(|p| p.to_vec2() * 1.5);
            assert!(pixels.clone().all(|p| (p - p.round()).length() < 1e-3), "{cells:?}");
            assert_eq!(cells.len(), count);
            for (i, cell) in cells.iter().enumerate() {
                assert!(area.expand(0.1).contains_rect(*cell), "{count} cells: {cell:?} in {area:?}");
                assert!(cells[..i].iter().all(|other| !other.shrink(0.1).intersects(cell.shrink(0.1))));
            }
        }
    }

    #[test]
    fn a_wide_area_has_its_panes_in_a_row_and_a_high_one_in_a_column() {
        assert!(arranged(area(1200.0, 400.0), 3, 1.0).iter().all(|c| c.top() == 20.0));
        assert!(arranged(area(300.0, 1200.0), 3, 1.0).iter().all(|c| c.left() == 10.0));
    }
}
