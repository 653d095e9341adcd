//! The places of the cells of a figure, and of the insets beside them.

use svbrdf_core::image::Image;

use super::column::{Column, NAME};
use super::crop::Crop;
use crate::export::text;

/// Pixels between two cells.
pub const GAP: usize = 4;
/// Pixels above the first row, for the names of columns and what they are of.
pub const HEADER: usize = 60;
/// Pixels around a name.
pub(super) const MARGIN: usize = 10;
/// Least height of a row: that of a legend.
const LEAST_ROW: usize = 52;
/// Pixels of a cell for one of the width of a frame, and the range of that.
const PER_LINE: usize = 128;
const LINES: [usize; 2] = [2, 16];

/// Where the cells of a figure are.
pub(super) struct Sheet {
    /// Width and height of a material.
    pub cell: [usize; 2],
    /// Height of a row.
    pub row: usize,
    rows: usize,
    /// Left edges and widths of the columns: texts of neighbours do not overlap.
    pub lefts: Vec<usize>,
    pub widths: Vec<usize>,
    width: usize,
    /// Width of the frames of crops.
    pub line: usize,
    pub insets: Vec<Inset>,
}

/// A crop, magnified beside every cell.
pub(super) struct Inset {
    pub crop: Crop,
    pub colour: [u8; 3],
    pub magnification: usize,
    /// From the upper left corner of the cell to its own, frame included.
    pub offset: [usize; 2],
}

impl Sheet {
    pub(super) fn new(columns: &[Column], cell: [usize; 2], names: &[String], crops: &[Crop]) -> Self {
        let line = (cell[0].min(cell[1]) / PER_LINE).clamp(LINES[0], LINES[1]);
        let insets = insets(crops, cell, line);
        let right = |inset: &Inset| inset.offset[0] + inset.size(line)[0];
        let wide = insets.iter().map(right).max().unwrap_or(cell[0]);
        let below = |inset: &Inset| inset.offset[1] + inset.size(line)[1];
        let high = insets.iter().map(below).max().unwrap_or(0);
        let mut width = names.iter().map(|name| text::width(name, NAME)).max().unwrap_or(0) + 2 * MARGIN;
        let (mut lefts, mut widths) = (Vec::new(), Vec::new());
        for column in columns {
            let texts = column.header();
            let text = texts.iter().map(|(line, height, _)| text::width(line, *height) + MARGIN).max();
            let own = wide.max(text.unwrap_or(0));
            lefts.push(width);
            widths.push(own);
            width += own + GAP;
        }
        let row = cell[1].max(LEAST_ROW).max(high);
        Self { cell, row, rows: names.len(), lefts, widths, width, line, insets }
    }

    pub(super) fn top(&self, row: usize) -> usize {
        HEADER + row * (self.row + GAP)
    }

    pub(super) fn size(&self) -> [usize; 2] {
        [self.width, self.top(self.rows)]
    }
}

impl Inset {
    /// Width and height, with a frame of width `line`.
    fn size(&self, line: usize) -> [usize; 2] {
        [self.crop.width, self.crop.height].map(|side| side * self.magnification + 2 * line)
    }
}

/// The insets of crops: one below the other beside the cell, in its height where they can be magnified in it.
fn insets(crops: &[Crop], cell: [usize; 2], line: usize) -> Vec<Inset> {
    let count = crops.len().max(1);
    let height = (cell[1].max(LEAST_ROW).saturating_sub((count - 1) * GAP)) / count;
    let room = [cell[0], height].map(|side| side.saturating_sub(2 * line));
    let mut top = 0;
    let inset = |(index, crop): (usize, &Crop)| {
        let magnification = crop.magnification(room);
        let offset = [cell[0] + GAP, top];
        let inset = Inset { crop: *crop, colour: Crop::colour(index), magnification, offset };
        top += inset.size(line)[1] + GAP;
        inset
    };
    crops.iter().enumerate().map(inset).collect()
}

/// Puts a picture at a place of another one.
pub(super) fn put(picture: &mut Image<u8>, [left, top]: [usize; 2], part: &Image<u8>) {
    for (row, pixels) in part.pixels.chunks(part.width).enumerate() {
        let start = (top + row) * picture.width + left;
        picture.pixels[start..start + part.width].copy_from_slice(pixels);
    }
}

#[cfg(test)]
mod tests {
    use svbrdf_core::model::scene::{Kind, Scene};
    use svbrdf_core::picture::content::PictureContent;
    use svbrdf_core::picture::quantity::Quantity;

    use super::*;

    fn columns(count: usize) -> Vec<Column> {
        let content = PictureContent { quantity: Quantity::Rendering, difference: None };
        let light = [-0.123, -0.456, 1.789];
        let scene = Scene { kind: Kind::Distant, view: [-0.111, -0.222, 2.333], light };
        vec![Column { content, scene }; count]
    }

    #[test]
    fn texts_of_narrow_columns_do_not_overlap_and_wide_columns_are_as_wide_as_the_material() {
        let columns = columns(3);
        for (side, is_wider) in [(16, true), (256, false)] {
            let sheet = Sheet::new(&columns, [side; 2], &["gt".to_owned()], &[]);
            for pair in sheet.lefts.windows(2) {
                for (line, height, _) in columns[0].header() {
                    assert!(pair[0] + text::width(&line, height) < pair[1], "{line} at {side}");
                }
                assert_eq!(pair[1] - pair[0] > side + GAP, is_wider, "{side}");
            }
        }
    }

    #[test]
    fn insets_stand_below_one_another_within_their_column_and_row() {
        let crops: Vec<Crop> =
            ["0,0,32,32", "100,90,64,20", "200,200,56,56"].map(|crop| crop.parse().unwrap()).into();
        for count in 1..=3 {
            let names = ["gt".to_owned(), "a".to_owned()];
            let sheet = Sheet::new(&columns(2), [256, 256], &names, &crops[..count]);
            let mut free = 0;
            for Inset { crop, magnification, offset, .. } in &sheet.insets {
                assert!(*magnification >= 2 && offset[0] == 256 + GAP && offset[1] >= free, "{crop}");
                free = offset[1] + crop.height * magnification + 2 * sheet.line;
                assert!(free <= sheet.row, "{crop} of {count}");
                assert!(offset[0] + crop.width * magnification + 2 * sheet.line <= sheet.widths[0], "{crop}");
            }
            assert!(sheet.lefts[1] >= sheet.lefts[0] + sheet.widths[0] + GAP);
        }
        let one = Sheet::new(&columns(1), [256, 256], &["gt".to_owned()], &crops[..1]);
        assert_eq!((one.insets[0].magnification, one.row), (7, 256), "252 pixels of 32 texels");
    }
}
