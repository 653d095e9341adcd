//! Inspection of texels: pins, and a rectangle.

pub mod pin;
pub mod region;

pub use pin::{HEADS, rows};
pub use region::Region;

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
}
