//! A rectangle of texels.

use std::iter;

/// A rectangle of texels, both ends included. On a repeated material it may go over a seam: then its last column or row is counted
/// on beyond the material, where the first one follows the last.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Region {
    /// The least (column, row); of the material.
    pub first: [usize; 2],
    /// The greatest (column, row); less than one material beyond the first.
    pub last: [usize; 2],
}

impl Region {
    /// (columns, rows).
    pub fn size(&self) -> [usize; 2] {
        [0, 1].map(|axis| (self.last[axis] - self.first[axis]).saturating_add(1))
    }

    /// Whether a material of `size` = (width, height) has all of it.
    pub fn fits(&self, size: [usize; 2]) -> bool {
        (0..2).all(|axis| self.first[axis] < size[axis] && self.size()[axis] <= size[axis])
    }

    /// (left, top, width, height), as graphics adapters take rectangles.
    pub fn rectangle(self) -> [u32; 4] {
        let ([left, top], [width, height]) = (self.first, self.size());
        [left, top, width, height].map(|number| number as u32)
    }

    /// Its parts within a material of `size` = (width, height): one, or on both sides of the seams that it goes over.
    pub fn parts(self, size: [usize; 2]) -> Vec<Self> {
        let [columns, rows] = [0, 1].map(|axis| ranges(self.first[axis], self.last[axis], size[axis]));
        let part = |rows: [usize; 2], columns: [usize; 2]| Self {
            first: [columns[0], rows[0]],
            last: [columns[1], rows[1]],
        };
        rows.iter().flat_map(|rows| columns.iter().map(|columns| part(*rows, *columns))).collect()
    }
}

/// The ranges of numbers below `count` that a range has which may go beyond it.
fn ranges(first: usize, last: usize, count: usize) -> Vec<[usize; 2]> {
    match last.checked_sub(count) {
        None => vec![[first, last]],
        Some(beyond) => iter::once([first, count - 1]).chain([[0, beyond]]).collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use svbrdf_core::material::Grid;

    use crate::model::view::texel_plane::TexelPlane;

    const GRID: Grid = Grid { width: 48, height: 20 };
    const SIZE: [usize; 2] = [48, 20];

    fn centre([column, row]: [usize; 2]) -> [f32; 2] {
        let p: glam::Vec3 = GRID.position(column, row);
        [p.x, p.y]
    }

    fn between(a: [f32; 2], b: [f32; 2]) -> Option<Region> {
        TexelPlane::new(GRID, false).region(a, b)
    }

    #[test]
    fn a_rectangle_holds_the_texels_under_its_corners_and_all_between() {
        for (a, b) in [([0, 0], [47, 19]), ([5, 7], [3, 12]), ([9, 9], [9, 9]), ([47, 0], [46, 1])] {
            let region = between(centre(a), centre(b)).unwrap();
            let first = [a[0].min(b[0]), a[1].min(b[1])];
            let last = [a[0].max(b[0]), a[1].max(b[1])];
            assert_eq!((region.first, region.last), (first, last));
            assert_eq!(GRID.texel_at(centre(a)), Some(a), "the readout and the rectangle agree");
            assert_eq!(region.parts(SIZE), [region]);
        }
    }

    #[test]
    fn a_rectangle_is_limited_to_the_material() {
        let all = between([-9.0, 9.0], [9.0, -9.0]).unwrap();
        assert_eq!((all.first, all.last), ([0, 0], [47, 19]));
        assert_eq!(between([2.0, 0.0], [3.0, 0.1]), None);
    }

    #[test]
    fn a_rectangle_over_seams_has_a_part_on_each_side() {
        let over_both = Region { first: [46, 18], last: [49, 21] };
        let corners = [([46, 18], [47, 19]), ([0, 18], [1, 19]), ([46, 0], [47, 1]), ([0, 0], [1, 1])];
        assert_eq!(over_both.parts(SIZE), corners.map(|(first, last)| Region { first, last }));
        let over_one = Region { first: [40, 3], last: [50, 4] };
        let parts = [Region { first: [40, 3], last: [47, 4] }, Region { first: [0, 3], last: [2, 4] }];
        assert_eq!(over_one.parts(SIZE), parts);
        assert!(over_one.fits(SIZE) && !over_one.fits([40, 20]) && !over_one.fits([48, 3]));
        assert!(!Region { first: [0, 0], last: [48, 0] }.fits(SIZE));
    }
}
