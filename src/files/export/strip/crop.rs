//! Crops of a figure: rectangles of texels that it frames and shows magnified.

use std::fmt;
use std::str::FromStr;

use svbrdf_core::image::Image;

use crate::error::Error;

/// The colours of crops, in their order, again from the first where there are more: those of Okabe and Ito (2008), which people
/// with any colour vision tell apart.
const COLOURS: [[u8; 3]; 6] =
    [[230, 159, 0], [86, 180, 233], [0, 158, 115], [240, 228, 66], [213, 94, 0], [204, 121, 167]];
const LEAST: usize = 2;

/// A rectangle of texels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Crop {
    /// The first column.
    pub left: usize,
    /// The first row.
    pub top: usize,
    /// At least 1.
    pub width: usize,
    /// At least 1.
    pub height: usize,
}

impl Crop {
    /// Checks that it lies within a material of `size`.
    ///
    /// # Errors
    /// [`Error::CropOutside`].
    pub(super) fn check(self, size: [usize; 2]) -> Result<(), Error> {
        let Self { left, top, width, height } = self;
        let ends = [left.checked_add(width), top.checked_add(height)];
        if ends.into_iter().zip(size).all(|(end, side)| end.is_some_and(|end| end <= side)) {
            return Ok(());
        }
        Err(Error::CropOutside { crop: [left, top, width, height], size })
    }

    pub(super) fn colour(index: usize) -> [u8; 3] {
        COLOURS[index % COLOURS.len()]
    }

    /// The largest whole magnification that fits into `room`, at least 2.
    pub(super) fn magnification(self, room: [usize; 2]) -> usize {
        (room[0] / self.width).min(room[1] / self.height).max(LEAST)
    }

    /// Its texels in `picture`, each as a square of `times` pixels.
    pub(super) fn magnified(self, picture: &Image<u8>, times: usize) -> Image<u8> {
        let size = [self.width, self.height].map(|side| side * times);
        let at = |x: usize, y: usize| {
            picture.pixels[(self.top + y / times) * picture.width + self.left + x / times]
        };
        let pixels = (0..size[1]).flat_map(|y| (0..size[0]).map(move |x| at(x, y))).collect();
        Image { width: size[0], height: size[1], pixels }
    }

    /// Draws its frame, `line` pixels wide, around its texels in `picture`; over them where there is no room.
    pub(super) fn frame(self, picture: &mut Image<u8>, line: usize, colour: [u8; 3]) {
        let [left, top] = [self.left, self.top].map(|first| first.saturating_sub(line));
        let right = (self.left + self.width + line).min(picture.width);
        let bottom = (self.top + self.height + line).min(picture.height);
        for y in top..bottom {
            for x in left..right {
                let is_inner = (left + line..right.saturating_sub(line)).contains(&x)
                    && (top + line..bottom.saturating_sub(line)).contains(&y);
                if !is_inner {
                    picture.pixels[y * picture.width + x] = colour;
                }
            }
        }
    }
}

impl FromStr for Crop {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let numbers: Result<Vec<usize>, _> = text.split(',').map(|part| part.trim().parse()).collect();
        match numbers.as_deref() {
            Ok(&[left, top, width, height]) if width > 0 && height > 0 => {
                Ok(Self { left, top, width, height })
            }
            _ => Err(format!(
                "expected left, top, width and height in texels, like 32,40,64,48, width and height at least 1, found `{text}`"
            )),
        }
    }
}

impl fmt::Display for Crop {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { left, top, width, height } = self;
        write!(f, "{left},{top},{width},{height}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn numbered(width: usize, height: usize) -> Image<u8> {
        let pixels = (0..width * height).map(|i| [(i % width) as u8, (i / width) as u8, 7]).collect();
        Image { width, height, pixels }
    }

    #[test]
    fn a_crop_is_four_numbers_and_has_texels() {
        assert_eq!("3, 4,5,6".parse(), Ok(Crop { left: 3, top: 4, width: 5, height: 6 }));
        for wrong in ["", "1,2,3", "1,2,3,4,5", "-1,2,3,4", "1,2,0,4", "1,2,3,0", "a,b,c,d", "1.5,2,3,4"] {
            assert!(wrong.parse::<Crop>().is_err_and(|e| e.contains("32,40,64,48")), "{wrong}");
        }
    }

    #[test]
    fn a_crop_lies_within_the_material() {
        let check = |text: &str| text.parse::<Crop>().unwrap().check([8, 6]);
        assert!(check("0,0,8,6").is_ok() && check("7,5,1,1").is_ok());
        for outside in ["8,0,1,1", "0,6,1,1", "3,0,6,1", "0,3,1,4", "18446744073709551615,0,2,1"] {
            let problem = check(outside).unwrap_err().to_string();
            assert!(problem.contains("8 x 6") && problem.contains(outside), "{problem}");
        }
    }

    #[test]
    fn a_texel_becomes_a_square() {
        let crop = Crop { left: 2, top: 1, width: 3, height: 2 };
        let inset = crop.magnified(&numbered(8, 6), 4);
        assert_eq!((inset.width, inset.height), (12, 8));
        for (i, pixel) in inset.pixels.iter().enumerate() {
            assert_eq!(*pixel, [(2 + i % 12 / 4) as u8, (1 + i / 12 / 4) as u8, 7], "{i}");
        }
        assert_eq!(crop.magnification([12, 100]), 4);
        assert_eq!(crop.magnification([100, 7]), 3);
        assert_eq!(crop.magnification([1, 1]), LEAST);
    }

    #[test]
    fn a_frame_is_around_its_texels_and_within_the_picture() {
        let red = [255, 0, 0];
        let framed = |text: &str| {
            let mut picture = numbered(12, 10);
            text.parse::<Crop>().unwrap().frame(&mut picture, 2, red);
            let is_red = |i: &usize| picture.pixels[*i] == red;
            (0..120).filter(is_red).map(|i| [i % 12, i / 12]).collect::<Vec<_>>()
        };
        let inner = framed("4,3,3,2");
        assert_eq!(inner.len(), 7 * 6 - 3 * 2);
        assert!(inner.iter().all(|[x, y]| !((4..7).contains(x) && (3..5).contains(y))), "{inner:?}");
        assert!(inner.iter().all(|[x, y]| (2..9).contains(x) && (1..7).contains(y)), "{inner:?}");
        // All four sides are seen at the border, too.
        let border = framed("0,0,12,10");
        assert_eq!(border.len(), 120 - 8 * 6);
    }
}
