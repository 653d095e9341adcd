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
    /// The texels between two points of the plane, both included; `None` where the material has none there.
    pub fn between(grid: Grid, a: [f32; 2], b: [f32; 2]) -> Option<Self> {
        let (a, b) = (grid.place(a), grid.place(b));
        let (mut first, mut last) = ([0; 2], [0; 2]);
        for (axis, count) in [grid.width, grid.height].into_iter().enumerate() {
            let (low, high) = (a[axis].min(b[axis]), a[axis].max(b[axis]));
            if high < 0.0 || low >= count as f32 {
                return None;
            }
            first[axis] = low.max(0.0) as usize;
            last[axis] = (high as usize).min(count - 1);
        }
        Some(Self { first, last })
    }

    /// (columns, rows).
    pub fn size(&self) -> [usize; 2] {
        [0, 1].map(|axis| (self.last[axis] - self.first[axis]).saturating_add(1))
    }

    /// Whether a material of `size` = (width, height) has all of it.
    pub fn fits(&self, size: [usize; 2]) -> bool {
        (0..2).all(|axis| self.last[axis] < size[axis])
    }

    /// The places of its upper left and its lower right corner.
    pub fn edges(&self) -> [[f32; 2]; 2] {
        [self.first.map(|number| number as f32), self.last.map(|number| number as f32 + 1.0)]
    }

    /// (left, top, width, height), as graphics adapters take rectangles.
    pub fn rectangle(self) -> [u32; 4] {
        let ([left, top], [width, height]) = (self.first, self.size());
        [left, top, width, height].map(|number| number as u32)
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
        }
    }

    #[test]
    fn a_rectangle_is_limited_to_the_material() {
        let all = Region::between(GRID, [-9.0, 9.0], [9.0, -9.0]).unwrap();
        assert_eq!((all.first, all.last), ([0, 0], [47, 19]));
        assert_eq!(Region::between(GRID, [2.0, 0.0], [3.0, 0.1]), None);
        assert!(all.fits([48, 20]) && !all.fits([47, 20]) && !all.fits([48, 19]));
    }
}
