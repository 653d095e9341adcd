//! Inspection of texels: pins, and a rectangle.

pub mod pin;

pub use pin::{HEADS, rows};

use svbrdf_core::material::Grid;
use svbrdf_files::session::window::SessionInspection;

/// Most pinned texels.
const MOST: usize = 12;

/// Pinned texels and the rectangle. Undo does not cover them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Inspection {
    /// The pinned (column, row)s, the earliest first.
    pub pins: Vec<[usize; 2]>,
    pub region: Option<Region>,
    /// Whether the next left-drag draws the rectangle.
    pub is_armed: bool,
}

impl Inspection {
    /// Pins a texel, or removes its pin. The earliest pin makes room for one too many.
    pub fn toggle_pin(&mut self, texel: [usize; 2]) {
        if let Some(index) = self.pins.iter().position(|pin| *pin == texel) {
            self.pins.remove(index);
            return;
        }
        self.pin(texel);
    }

    fn pin(&mut self, texel: [usize; 2]) {
        self.pins.retain(|pin| *pin != texel);
        if self.pins.len() == MOST {
            self.pins.remove(0);
        }
        self.pins.push(texel);
    }

    /// Drops what lies outside of materials of `size` = (width, height).
    pub fn keep_within(&mut self, size: [usize; 2]) {
        self.pins.retain(|pin| pin[0] < size[0] && pin[1] < size[1]);
        self.region = self.region.filter(|region| region.fits(size));
    }
}

impl From<&Inspection> for SessionInspection {
    fn from(inspection: &Inspection) -> Self {
        let rectangle = inspection.region.map(|region| [region.first, region.last]);
        Self { pins: inspection.pins.clone(), rectangle }
    }
}

impl From<&SessionInspection> for Inspection {
    /// Leaves out what no material has.
    fn from(saved: &SessionInspection) -> Self {
        let mut inspection = Self::default();
        saved.pins.iter().for_each(|pin| inspection.pin(*pin));
        let is_ordered = |[first, last]: &[[usize; 2]; 2]| (0..2).all(|axis| first[axis] <= last[axis]);
        inspection.region = saved.rectangle.filter(is_ordered).map(|[first, last]| Region { first, last });
        inspection
    }
}

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

    #[test]
    fn a_pin_is_set_once_and_removed_by_setting_it_again() {
        let mut inspection = Inspection::default();
        for texel in [[1, 2], [3, 4], [1, 2]] {
            inspection.toggle_pin(texel);
        }
        assert_eq!(inspection.pins, [[3, 4]]);
        (0..20).for_each(|i| inspection.toggle_pin([i, 9]));
        assert_eq!((inspection.pins.len(), inspection.pins[0]), (MOST, [8, 9]));
        inspection.keep_within([10, 10]);
        assert_eq!(inspection.pins, [[8, 9], [9, 9]]);
        inspection.keep_within([10, 9]);
        assert!(inspection.pins.is_empty());
    }

    #[test]
    fn what_a_session_holds_comes_back_and_no_number_of_it_breaks_the_window() {
        let region = Some(Region { first: [2, 3], last: [9, 3] });
        let inspection = Inspection { pins: vec![[1, 2], [3, 4]], region, is_armed: false };
        assert_eq!(Inspection::from(&SessionInspection::from(&inspection)), inspection);
        let rectangles = [[[5, 5], [4, 6]], [[0, 0], [usize::MAX, usize::MAX]], [[usize::MAX; 2]; 2]];
        for rectangle in rectangles {
            let pins = (0..40).map(|i| [usize::MAX - i, 0]).collect();
            let mut found = Inspection::from(&SessionInspection { pins, rectangle: Some(rectangle) });
            assert_eq!(found.pins.len(), MOST);
            found.keep_within([256, 256]);
            assert!(found.pins.is_empty() && found.region.is_none(), "{found:?}");
        }
    }

    const GRID: Grid = Grid { width: 48, height: 20 };

    #[test]
    fn a_rectangle_is_limited_to_the_material() {
        let all = Region::between(GRID, [-9.0, 9.0], [9.0, -9.0]).unwrap();
        assert_eq!((all.first, all.last), ([0, 0], [47, 19]));
        assert_eq!(Region::between(GRID, [2.0, 0.0], [3.0, 0.1]), None);
        assert!(all.fits([48, 20]) && !all.fits([47, 20]) && !all.fits([48, 19]));
    }
}
