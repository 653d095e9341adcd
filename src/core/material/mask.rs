//! Masks: which texels of a material are compared.

use std::sync::Arc;

use super::resize::{self, Filter};
use crate::image::Image;

/// The colour of texels that are not compared.
const OUTSIDE: [u8; 3] = [128; 3];

/// Of each texel of a material whether it is compared; at least one is.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Mask {
    size: [usize; 2],
    kept: Arc<[bool]>,
}

impl Mask {
    /// A mask of this width and height, row 0 on top; `None` where it keeps no texel, or has another number of them.
    pub fn new(size: [usize; 2], kept: Vec<bool>) -> Option<Self> {
        let is_usable = kept.len() == size[0] * size[1] && kept.contains(&true);
        is_usable.then(|| Self { size, kept: kept.into() })
    }

    /// Width and height.
    pub fn size(&self) -> [usize; 2] {
        self.size
    }

    /// Whether each texel is compared, as row * width + column.
    pub fn kept(&self) -> &[bool] {
        &self.kept
    }

    /// The texels that are compared.
    pub fn texels(&self) -> Vec<usize> {
        (0..self.kept.len()).filter(|texel| self.kept[*texel]).collect()
    }

    /// The mask in another size: a texel is compared where at least half of its area is. `None` where none is left.
    pub fn resized(&self, size: [usize; 2]) -> Option<Self> {
        let plane: Vec<f32> = self.kept.iter().map(|kept| f32::from(u8::from(*kept))).collect();
        let resized = resize::plane(plane, self.size, size, Filter::Value);
        Self::new(size, resized.into_iter().map(|share| share >= 0.5).collect())
    }

    /// The part of `size` from the texel `at` on; `None` where none is left, or it is no part.
    pub fn part(&self, at: [usize; 2], size: [usize; 2]) -> Option<Self> {
        let is_inside = (0..2).all(|axis| at[axis] + size[axis] <= self.size[axis]);
        let row = |y: usize| &self.kept[(at[1] + y) * self.size[0] + at[0]..][..size[0]];
        is_inside.then(|| Self::new(size, (0..size[1]).flat_map(row).copied().collect())).flatten()
    }

    /// Draws texels that are not compared gray, in a picture of the material in any size.
    pub fn gray_outside(&self, picture: &mut Image<u8>) {
        let [width, height] = [picture.width, picture.height];
        let at = |x: usize, y: usize| (y * self.size[1] / height) * self.size[0] + x * self.size[0] / width;
        for (place, pixel) in picture.pixels.iter_mut().enumerate() {
            if !self.kept[at(place % width, place / width)] {
                *pixel = OUTSIDE;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_mask_is_cut_and_resized_with_its_material() {
        let kept = (0..16).map(|texel| texel % 4 >= 2 || texel == 0).collect();
        let mask = Mask::new([4, 4], kept).unwrap();
        assert_eq!(mask.resized([2, 2]).unwrap().texels(), [1, 3], "a quarter of a texel is not half");
        assert_eq!(mask.part([1, 1], [2, 3]).unwrap().kept(), [false, true, false, true, false, true]);
        assert_eq!([mask.part([0, 1], [2, 2]), mask.part([2, 2], [3, 1])], [None, None]);
        assert_eq!([Mask::new([2, 1], vec![false; 2]), Mask::new([2, 1], vec![true])], [None, None]);
        let mut picture = Image { width: 2, height: 1, pixels: vec![[7; 3]; 2] };
        mask.part([1, 1], [2, 3]).unwrap().gray_outside(&mut picture);
        assert_eq!(picture.pixels, [OUTSIDE, [7; 3]]);
    }
}
