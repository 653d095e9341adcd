//! A rectangle of texels.

use svbrdf_core::material::Grid;

/// A rectangle of texels, both ends included.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Region {
    /// The least (column, row).
    pub first: [usize; 2],
    /// The greatest (column, row).
    pub last: [usize; 2],
}

impl Region {
    /// The texels between two points of the plane, limited to the material; `None` where it holds none of them.
    pub fn between(grid: Grid, a: [f32; 2], b: [f32; 2]) -> Option<Self> {
        let [half_width, half_height] = grid.half_extent();
        // From points of the plane to (column, row), counted from the corner of the material.
        let per_unit = 0.5 * grid.width as f32 / half_width;
        let place = |[x, y]: [f32; 2]| [(x + half_width) * per_unit, (half_height - y) * per_unit];
        let (a, b) = (place(a), place(b));
        let counts = [grid.width, grid.height];
        let mut region = Self { first: [0; 2], last: [0; 2] };
        for axis in 0..2 {
            let (low, high) = (a[axis].min(b[axis]), a[axis].max(b[axis]));
            if high < 0.0 || low >= counts[axis] as f32 {
                return None;
            }
            region.first[axis] = low.max(0.0) as usize;
            region.last[axis] = (high as usize).min(counts[axis] - 1);
        }
        Some(region)
    }

    /// (columns, rows).
    pub fn size(&self) -> [usize; 2] {
        [0, 1].map(|axis| self.last[axis] - self.first[axis] + 1)
    }

    /// (left, top, width, height), as graphics adapters take rectangles.
    pub fn rectangle(self) -> [u32; 4] {
        let ([left, top], [width, height]) = (self.first, self.size());
        [left, top, width, height].map(|number| number as u32)
    }

    /// Every (column, row), row by row.
    pub fn texels(self) -> impl Iterator<Item = [usize; 2]> {
        let columns = self.first[0]..=self.last[0];
        (self.first[1]..=self.last[1]).flat_map(move |row| columns.clone().map(move |column| [column, row]))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const GRID: Grid = Grid { width: 48, height: 20 };

    fn centre([column, row]: [usize; 2]) -> [f32; 2] {
        let p: glam::Vec3 = GRID.position(column, row);
        [p.x, p.y]
    }

    #[test]
    fn a_rectangle_holds_the_texels_under_its_corners_and_all_between() {
        for (a, b) in [([0, 0], [47, 19]), ([5, 7], [3, 12]), ([9, 9], [9, 9]), ([47, 0], [46, 1])] {
            let region = Region::between(GRID, centre(a), centre(b)).unwrap();
            let first = [a[0].min(b[0]), a[1].min(b[1])];
            let last = [a[0].max(b[0]), a[1].max(b[1])];
            assert_eq!((region.first, region.last), (first, last));
            assert_eq!(GRID.texel_at(centre(a)), Some(a), "the readout and the rectangle agree");
            let texels: Vec<_> = region.texels().collect();
            let [columns, rows] = region.size();
            assert_eq!((texels.len(), texels[0], *texels.last().unwrap()), (columns * rows, first, last));
        }
    }

    #[test]
    fn a_rectangle_is_limited_to_the_material() {
        let all = Region::between(GRID, [-9.0, 9.0], [9.0, -9.0]).unwrap();
        assert_eq!((all.first, all.last), ([0, 0], [47, 19]));
        assert_eq!(Region::between(GRID, [2.0, 0.0], [3.0, 0.1]), None);
    }
}
