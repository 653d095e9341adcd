//! The layout of NumPy arrays: which axes are rows, columns and channels.
//!
//! Pictures are (h, w), (h, w, channels), (channels, h, w), (1, h, w, channels) or (1, channels, h, w) of at most 4 channels. A shape such as
//! (1, 1, 3) is one of (h, w, channels) and of (channels, h, w): the other arrays of the file decide, as maps of one
//! material have one size; where they do not, channels come last and a note is recorded.

use crate::read::record::Note;

const MOST: u64 = 4;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct ArrayAxes {
    pub height: u64,
    pub width: u64,
    pub count: u64,
    pub planar: bool,
    /// Whether the channels could as well be at the other end.
    pub is_ambiguous: bool,
}

impl ArrayAxes {
    fn new(size: [u64; 2], count: u64, planar: bool) -> Self {
        Self { height: size[0], width: size[1], count, planar, is_ambiguous: false }
    }

    fn size(&self) -> [u64; 2] {
        [self.height, self.width]
    }
}

/// The readings of a shape, channels last before channels first; none where it is that of no picture.
fn readings(shape: &[u64]) -> Vec<ArrayAxes> {
    let are_channels = |count: u64| (1..=MOST).contains(&count);
    match *shape {
        [h, w] => vec![ArrayAxes::new([h, w], 1, false)],
        // A batch of one.
        [1, a, b, c] => readings(&[a, b, c]),
        // The same picture either way.
        [1, 1, 1] => vec![ArrayAxes::new([1, 1], 1, false)],
        [a, b, c] => {
            let last = are_channels(c).then(|| ArrayAxes::new([a, b], c, false));
            let first = are_channels(a).then(|| ArrayAxes::new([b, c], a, true));
            last.into_iter().chain(first).collect()
        }
        _ => Vec::new(),
    }
}

/// The number of materials, where the arrays of a file are batches of as many: (n, h, w, channels), beside which (n, h, w) is one, too.
pub(super) fn batch(shapes: &[Vec<u64>]) -> Option<u64> {
    let of = |shape: &Vec<u64>| match *shape.as_slice() {
        [n, _, _, c] if n > 1 && (1..=MOST).contains(&c) => Some(n),
        _ => None,
    };
    let first = shapes.iter().find_map(of)?;
    shapes.iter().filter_map(of).all(|n| n == first).then_some(first)
}

/// The reading of each shape of a file, decided from all of them together. The materials of a batch stand below each other.
pub(super) fn chosen(shapes: &[Vec<u64>]) -> impl Iterator<Item = Option<ArrayAxes>> {
    let batch = batch(shapes);
    let read = |shape: &Vec<u64>| match *shape.as_slice() {
        [n, h, w, c] if Some(n) == batch => vec![ArrayAxes::new([n.saturating_mul(h), w], c, false)],
        [n, h, w] if Some(n) == batch => vec![ArrayAxes::new([n.saturating_mul(h), w], 1, false)],
        _ => readings(shape),
    };
    let all: Vec<_> = shapes.iter().map(read).collect();
    let sizes: Vec<_> = all.iter().filter(|one| one.len() == 1).map(|one| one[0].size()).collect();
    let several: Vec<_> = all.iter().filter(|one| one.len() > 1).collect();
    // Whether channels first, or last, gives all arrays of two readings one size.
    let agrees =
        |planar: usize| several.windows(2).all(|pair| pair[0][planar].size() == pair[1][planar].size());
    let together = match [agrees(0), agrees(1)] {
        [false, true] => Some(1),
        [true, false] => Some(0),
        _ => None,
    };
    let choose = move |readings: Vec<ArrayAxes>| {
        let [last, first] = readings.as_slice() else { return readings.first().copied() };
        match [last, first].map(|axes| sizes.contains(&axes.size())) {
            [true, false] => Some(*last),
            [false, true] => Some(*first),
            _ => {
                // Two channels, or four, usually come last.
                let default = ArrayAxes { is_ambiguous: matches!(first.count, 1 | 3), ..*last };
                Some(together.map_or(default, |number| [*last, *first][number]))
            }
        }
    };
    all.into_iter().map(choose)
}

/// The note where nothing but the default told the axes of the array `name`.
pub(super) fn note(name: &str, shape: &[u64], axes: Option<ArrayAxes>) -> Option<Note> {
    let is_ambiguous = axes.is_some_and(|axes| axes.is_ambiguous);
    is_ambiguous.then(|| {
        // An array of a file by itself has no name.
        let array = if name.is_empty() { "The array".to_owned() } else { format!("Array {name}") };
        let shape = shape.iter().map(ToString::to_string).collect::<Vec<_>>().join(", ");
        Note::Told(format!(
            "{array} of the shape ({shape}) is read as rows, columns and channels; channels could also come first."
        ))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The size and channels of each shape, and whether its reading is the default.
    fn read(shapes: &[&[u64]]) -> Vec<([u64; 2], u64, bool)> {
        let shapes: Vec<_> = shapes.iter().map(|shape| shape.to_vec()).collect();
        let read = chosen(&shapes).map(|axes| axes.map(|axes| (axes.size(), axes.count, axes.is_ambiguous)));
        read.map(|axes| axes.unwrap()).collect()
    }

    #[test]
    fn batches_of_materials_stand_below_each_other() {
        let read = read(&[&[3, 64, 32, 3], &[3, 64, 32], &[3, 64, 32, 1]]);
        let [size, one] = [[192, 32], [192, 32]];
        assert_eq!(read, [(size, 3, false), (one, 1, false), (one, 1, false)]);
        assert_eq!(batch(&[vec![3, 64, 32, 3], vec![2, 64, 32, 3]]), None);
        assert_eq!(batch(&[vec![1, 64, 32, 3]]), None);
    }

    #[test]
    fn a_shape_with_one_reading_needs_no_others() {
        assert_eq!(
            read(&[&[5, 6], &[5, 6, 3], &[3, 5, 6], &[1, 3, 5, 6], &[1, 5, 6, 3], &[1, 5, 6], &[1, 1, 1]]),
            [
                ([5, 6], 1, false),
                ([5, 6], 3, false),
                ([5, 6], 3, false),
                ([5, 6], 3, false),
                ([5, 6], 3, false),
                ([5, 6], 1, false),
                ([1, 1], 1, false),
            ]
        );
        for shape in [&[5][..], &[5, 6, 7], &[2, 3, 5, 6], &[5, 6, 7, 8, 9]] {
            assert_eq!(chosen(&[shape.to_vec()]).next(), Some(None), "{shape:?}");
        }
    }

    #[test]
    fn a_small_shape_takes_the_layout_that_gives_all_arrays_one_size() {
        assert_eq!(read(&[&[1, 1, 3], &[1, 1, 1]]), [([1, 1], 3, false), ([1, 1], 1, false)]);
        assert_eq!(read(&[&[4, 4, 3], &[4, 4]]), [([4, 4], 3, false), ([4, 4], 1, false)]);
        assert_eq!(read(&[&[3, 4, 4], &[4, 4]]), [([4, 4], 3, false), ([4, 4], 1, false)]);
        assert_eq!(read(&[&[3, 4, 4], &[1, 4, 4]]), [([4, 4], 3, false), ([4, 4], 1, false)]);
        assert_eq!(read(&[&[1, 4, 3], &[1, 4, 2]]), [([1, 4], 3, false), ([1, 4], 2, false)]);
    }

    #[test]
    fn a_shape_that_nothing_decides_has_its_channels_last() {
        assert_eq!(read(&[&[1, 1, 3]]), [([1, 1], 3, true)]);
        assert_eq!(read(&[&[3, 3, 3], &[3, 3, 3]]), [([3, 3], 3, true); 2]);
        assert_eq!(read(&[&[3, 4, 4]]), [([3, 4], 4, true)]);
        assert_eq!(read(&[&[2, 3, 3]]), [([2, 3], 3, false)]);
    }
}
