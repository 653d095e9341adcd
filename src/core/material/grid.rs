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

    /// The (column, row) of the texel that covers the point (x, y) of the plane; `None` outside of the material.
    pub fn texel_at(&self, [x, y]: [f32; 2]) -> Option<[usize; 2]> {
        let [half_width, half_height] = self.half_extent();
        let index = |distance: f32, count: usize| {
            let i = (distance * self.half_spacings() / 2.0).floor();
            (i >= 0.0 && i < count as f32).then_some(i as usize)
        };
        Some([index(x + half_width, self.width)?, index(half_height - y, self.height)?])
    }

    /// As [`Grid::texel_at`], where the material is repeated 2 x 2 times in its own place, shifted by half of itself.
    pub fn repeated_texel_at(&self, [x, y]: [f32; 2]) -> Option<[usize; 2]> {
        self.texel_at([x, y])?;
        let [half_width, half_height] = self.half_extent();
        let index = |distance: f32, count: usize| {
            let texel = distance * self.half_spacings() / 2.0;
            ((2.0 * texel + 0.5 * count as f32).rem_euclid(count as f32) as usize).min(count - 1)
        };
        Some([index(x + half_width, self.width), index(half_height - y, self.height)])
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
