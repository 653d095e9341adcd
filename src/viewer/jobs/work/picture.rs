//! Picture made by a job, for a texture of the window.

use std::sync::Arc;

/// Pixels of sRGB with premultiplied alpha, row by row from the top.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PanelPicture {
    /// Width and height.
    pub size: [usize; 2],
    pub pixels: Vec<[u8; 4]>,
}

impl PanelPicture {
    /// A pixel that hides what is behind it.
    pub fn opaque([r, g, b]: [u8; 3]) -> [u8; 4] {
        [r, g, b, 255]
    }

    /// A pixel that shows what is behind it.
    pub const TRANSPARENT: [u8; 4] = [0; 4];
}

/// Pictures in one, in cells of the size of the largest.
#[derive(Debug)]
pub struct Atlas {
    pub picture: Arc<PanelPicture>,
    /// The upper left corner and the size of each.
    parts: Vec<[[usize; 2]; 2]>,
}

impl Atlas {
    pub fn new(pictures: &[PanelPicture]) -> Self {
        let side = |axis: usize| pictures.iter().map(|one| one.size[axis]).max().unwrap_or(1);
        let columns = (pictures.len() as f64).sqrt().ceil().max(1.0) as usize;
        let sides = [side(0), side(1)];
        let size = [columns * sides[0], pictures.len().div_ceil(columns).max(1) * sides[1]];
        let mut picture = PanelPicture { size, pixels: vec![PanelPicture::TRANSPARENT; size[0] * size[1]] };
        let mut parts = Vec::new();
        for (index, one) in pictures.iter().enumerate() {
            let least = [index % columns * sides[0], index / columns * sides[1]];
            for (row, line) in one.pixels.chunks(one.size[0].max(1)).enumerate() {
                let start = (least[1] + row) * size[0] + least[0];
                picture.pixels[start..start + line.len()].copy_from_slice(line);
            }
            parts.push([least, one.size]);
        }
        Self { picture: Arc::new(picture), parts }
    }

    /// The part that is the picture of this number: least and greatest x and y, as shares of its sides; and its size in pixels.
    pub fn part(&self, number: usize) -> Option<([[f32; 2]; 2], [usize; 2])> {
        let [least, size] = self.parts.get(number)?;
        let share = |at: [usize; 2]| [0, 1].map(|axis| at[axis] as f32 / self.picture.size[axis] as f32);
        Some(([share(*least), share([least[0] + size[0], least[1] + size[1]])], *size))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_part_of_the_picture_is_one_of_the_pictures() {
        let sizes = [[3, 2], [2, 3], [3, 3], [1, 1]];
        let one = |(shade, size): (u8, [usize; 2])| PanelPicture {
            size,
            pixels: vec![[shade, 0, 0, 255]; size[0] * size[1]],
        };
        let atlas = Atlas::new(&(0..).zip(sizes).map(one).collect::<Vec<_>>());
        assert_eq!(atlas.picture.size, [6, 6]);
        assert!(atlas.part(4).is_none());
        for (shade, expected) in sizes.into_iter().enumerate() {
            let ([least, most], size) = atlas.part(shade).unwrap();
            let [first, last] = [least, most].map(|at| [0, 1].map(|axis| (at[axis] * 6.0).round() as usize));
            assert_eq!(([last[0] - first[0], last[1] - first[1]], size), (expected, expected));
            let places = (first[1]..last[1]).flat_map(|y| (first[0]..last[0]).map(move |x| [x, y]));
            let shade = [shade as u8, 0, 0, 255];
            assert!(places.into_iter().all(|[x, y]| atlas.picture.pixels[y * 6 + x] == shade));
        }
    }
}
