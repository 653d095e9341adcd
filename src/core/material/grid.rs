//! Positions of the texels of a material.

use crate::math::real::{Real as _, Vector};

/// Where the texels of a material lie in the plane z = 0.
///
/// Column i of W is at `x = linspace(-1, 1, W)[i]`; row 0 is on top, at the largest y; texels are square, so the
/// height spans +-(H - 1) / (W - 1). A single column lies at x = 0, with rows as far apart as those of two columns.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Grid {
    pub width: usize,
    pub height: usize,
}

impl Grid {
    /// Half the (width, height) of the plane that the texels cover, half a texel beyond the outermost positions.
    pub fn half_extent(&self) -> [f32; 2] {
        [self.width, self.height].map(|n| n as f32 / self.half_spacings())
    }

    /// The place (column, row) of the point (x, y) of the plane, counted in texels from the upper left corner of the material:
    /// texel (i, j) covers the places from (i, j) to (i + 1, j + 1).
    pub fn place(&self, [x, y]: [f32; 2]) -> [f32; 2] {
        let [half_width, half_height] = self.half_extent();
        [x + half_width, half_height - y].map(|distance| distance * self.half_spacings() / 2.0)
    }

    /// The point (x, y) of the plane at a place: the inverse of [`Grid::place`].
    pub fn point(&self, place: [f32; 2]) -> [f32; 2] {
        let [half_width, half_height] = self.half_extent();
        let [right, down] = place.map(|texels| texels * 2.0 / self.half_spacings());
        [right - half_width, half_height - down]
    }

    /// The (column, row) of the texel that covers the point (x, y) of the plane; `None` outside of the material.
    pub fn texel_at(&self, point: [f32; 2]) -> Option<[usize; 2]> {
        let [column, row] = self.place(point);
        let index =
            |place: f32, count: usize| (place >= 0.0 && place < count as f32).then_some(place as usize);
        Some([index(column, self.width)?, index(row, self.height)?])
    }

    /// How many halves of the distance between two texels make a unit of length.
    fn half_spacings(&self) -> f32 {
        self.width.saturating_sub(1).max(1) as f32
    }

    /// The position C of the texel in column `column` of row `row`.
    pub fn position<V: Vector>(&self, column: usize, row: usize) -> V {
        let scale = self.width.saturating_sub(1).max(1) as f64;
        let x = (2.0 * column as f64 - (self.width - 1) as f64) / scale;
        let y = ((self.height - 1) as f64 - 2.0 * row as f64) / scale;
        V::from([x, y, 0.0].map(V::Scalar::of))
    }
}
