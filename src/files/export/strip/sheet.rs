//! The places of the cells of a figure, and of the insets beside them, in points.

use svbrdf_core::image::Image;

use super::crop::Crop;
use crate::error::Error;
use crate::export::figure::{Anchor, Figure, MILLIMETRE, TextStyle};

pub(super) const INK: [u8; 3] = [24; 3];
/// Size of what stands beside names, in ems.
pub(super) const SMALL: f64 = 0.86;
/// Space between cells and beside names, in ems.
pub(super) const GAP: f64 = 0.4;
pub(super) const MARGIN: f64 = 0.8;
/// Widths of a column and of two columns of a paper, in millimetres, and most cells beside one another in the first.
const COLUMN: f64 = 88.0;
const PAGE: f64 = 180.0;
const IN_COLUMN: usize = 3;
/// Most of the width that names of rows take.
const NAMES: f64 = 0.2;
/// Least width of a cell in ems: where the width is given, and where it is not.
const LEAST: [f64; 2] = [4.0, 8.0];
/// Least pixels of a point in a PNG.
const PIXELS: f64 = 2.0;
/// Texels of a cell for one of the width of a frame, and the range of that.
const PER_LINE: usize = 128;
const LINES: [usize; 2] = [1, 16];
/// Texels between a cell and its insets: a share of the width of the cell.
const BESIDE: usize = 64;

/// The size of a figure.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Paper {
    /// `None`: 88 mm for up to three cells beside one another, else 180 mm, or more where that would leave no room.
    pub width_mm: Option<f64>,
    /// The size of names; other texts are a little smaller.
    pub text_pt: f64,
}

impl Default for Paper {
    fn default() -> Self {
        Self { width_mm: None, text_pt: 7.0 }
    }
}

pub(super) fn style(size: f64, anchor: Anchor) -> TextStyle {
    TextStyle { size, ink: INK, anchor }
}

pub(super) struct Sheet {
    pub em: f64,
    /// Of the figure.
    pub width: f64,
    pub names: f64,
    pub column: f64,
}

impl Sheet {
    /// A sheet of this number of columns beside the names of rows.
    ///
    /// # Errors
    /// [`Error::FigureTooNarrow`].
    pub(super) fn new(
        paper: Paper,
        columns: usize,
        names: &[String],
        has_insets: bool,
    ) -> Result<Self, Error> {
        let Paper { width_mm, text_pt: em } = paper;
        let is_narrow = columns <= IN_COLUMN && !has_insets;
        let mut width = width_mm.unwrap_or(if is_narrow { COLUMN } else { PAGE }) * MILLIMETRE;
        let gap = GAP * em;
        let widest = names.iter().map(|name| Figure::text_width(name, em)).fold(0.0, f64::max);
        // A little more than the text: it is broken where it is as wide as its room but for rounding.
        let names = (1.01 * widest).min(NAMES * width) + MARGIN * em;
        let least = LEAST.map(|least| names + columns as f64 * (least * em + gap) - gap);
        match width_mm {
            None => width = width.max(least[1]),
            Some(width_mm) if width < least[0] => {
                let [least, text_pt] = [least[0] / MILLIMETRE, em];
                return Err(Error::FigureTooNarrow { width_mm, columns, text_pt, least });
            }
            Some(_) => {}
        }
        let column = (width - names + gap) / columns.max(1) as f64 - gap;
        Ok(Self { em, width, names, column })
    }

    pub(super) fn left(&self, column: usize) -> f64 {
        self.names + column as f64 * (self.column + GAP * self.em)
    }

    /// Writes headings, each above its column and ending at the same height, which is returned.
    pub(super) fn headings(&self, figure: &mut Figure, headings: &[Vec<(String, f64)>]) -> f64 {
        let height = |(text, size): &(String, f64)| Figure::text_height(text, self.column, size * self.em);
        let of = |heading: &Vec<(String, f64)>| heading.iter().map(height).sum::<f64>();
        let bottom = headings.iter().map(of).fold(0.0, f64::max);
        for (column, heading) in headings.iter().enumerate() {
            let mut top = bottom - of(heading);
            for (text, size) in heading {
                let at = [self.left(column), top];
                top = figure.text(at, self.column, text, style(size * self.em, Anchor::Left));
            }
        }
        bottom + GAP * self.em
    }

    /// Writes the name of a row beside cells of this height.
    pub(super) fn name(&self, figure: &mut Figure, top: f64, height: f64, name: &str) {
        let width = self.names - MARGIN * self.em;
        let text = Figure::text_height(name, width, self.em);
        let top = top + (0.5 * (height - text)).max(0.0);
        figure.text([0.0, top], width, name, style(self.em, Anchor::Left));
    }

    /// Writes a note over the whole width; returns its bottom.
    pub(super) fn note(&self, figure: &mut Figure, top: f64, text: &str) -> f64 {
        figure.text([0.0, top], self.width, text, style(SMALL * self.em, Anchor::Left))
    }
}

/// How a cell is divided between a material and its insets.
pub(super) struct Division {
    /// The width of a texel in points.
    pub texel: f64,
    /// Height of the cell in points.
    pub height: f64,
    /// Width of the frames of crops, in texels.
    line: usize,
    insets: Vec<Inset>,
}

/// A crop, magnified beside a cell. Lengths are in texels of the cell.
struct Inset {
    crop: Crop,
    colour: [u8; 3],
    magnification: usize,
    /// From the upper left corner of the cell to its own, frame included.
    offset: [usize; 2],
}

impl Inset {
    /// Width and height, with a frame of width `line`.
    fn size(&self, line: usize) -> [usize; 2] {
        [self.crop.width, self.crop.height].map(|side| side * self.magnification + 2 * line)
    }
}

impl Division {
    /// A cell of `size` texels and the insets of its crops in a column of this width in points.
    ///
    /// # Errors
    /// [`Error::CropOutside`].
    pub(super) fn new(size: [usize; 2], crops: &[Crop], width: f64) -> Result<Self, Error> {
        crops.iter().try_for_each(|crop| crop.check(size))?;
        let line = (size[0].min(size[1]) / PER_LINE).clamp(LINES[0], LINES[1]);
        let insets = insets(crops, size, line);
        let end = |axis: usize| move |inset: &Inset| inset.offset[axis] + inset.size(line)[axis];
        let wide = insets.iter().map(end(0)).fold(size[0], usize::max);
        let high = insets.iter().map(end(1)).fold(size[1], usize::max);
        let texel = width / wide.max(1) as f64;
        Ok(Self { texel, height: high as f64 * texel, line, insets })
    }

    /// Pixels of a point at which a texel is a whole number of pixels.
    pub(super) fn scale(&self) -> f64 {
        (PIXELS * self.texel).ceil() / self.texel
    }

    /// Puts a cell with its frames at a place, and its insets beside it.
    pub(super) fn put(&self, figure: &mut Figure, [left, top]: [f64; 2], mut cell: Image<u8>) {
        let Self { texel, line, .. } = *self;
        let size = |image: &Image<u8>| [image.width, image.height].map(|side| side as f64 * texel);
        for Inset { crop, colour, magnification, offset } in &self.insets {
            let inset = framed(&crop.magnified(&cell, *magnification), line, *colour);
            let at = [left + offset[0] as f64 * texel, top + offset[1] as f64 * texel];
            figure.picture(at, size(&inset), inset);
        }
        // After all insets, which show no frames.
        for Inset { crop, colour, .. } in &self.insets {
            crop.frame(&mut cell, line, *colour);
        }
        figure.picture([left, top], size(&cell), cell);
    }
}

fn framed(picture: &Image<u8>, line: usize, colour: [u8; 3]) -> Image<u8> {
    let [width, height] = [picture.width, picture.height].map(|side| side + 2 * line);
    let mut pixels = vec![colour; width * height];
    for (y, row) in picture.pixels.chunks(picture.width).enumerate() {
        pixels[(line + y) * width + line..][..row.len()].copy_from_slice(row);
    }
    Image { width, height, pixels }
}

/// The insets of crops: one below the other beside the cell, in its height where they can be magnified in it.
fn insets(crops: &[Crop], cell: [usize; 2], line: usize) -> Vec<Inset> {
    let gap = (cell[0] / BESIDE).max(1);
    let count = crops.len().max(1);
    let height = cell[1].saturating_sub((count - 1) * gap) / count;
    let room = [cell[0], height].map(|side| side.saturating_sub(2 * line));
    let mut top = 0;
    let inset = |(index, crop): (usize, &Crop)| {
        let magnification = crop.magnification(room);
        let offset = [cell[0] + gap, top];
        let inset = Inset { crop: *crop, colour: Crop::colour(index), magnification, offset };
        top += inset.size(line)[1] + gap;
        inset
    };
    crops.iter().enumerate().map(inset).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_fill_the_width_beside_the_names() {
        let names = ["gt".to_owned(), "ours".to_owned()];
        for (columns, millimetres) in [(2, 88.0), (3, 88.0), (4, 180.0), (7, 180.0)] {
            let sheet = Sheet::new(Paper::default(), columns, &names, false).unwrap();
            assert!((sheet.width - millimetres * MILLIMETRE).abs() < 1e-9, "{columns}");
            assert!((sheet.left(columns - 1) + sheet.column - sheet.width).abs() < 1e-9, "{columns}");
            assert!(sheet.names >= Figure::text_width("ours", 7.0) + GAP * 7.0);
        }
        let many = Sheet::new(Paper::default(), 40, &names, false).unwrap();
        assert!(many.width > 180.0 * MILLIMETRE && many.column >= 8.0 * 7.0 - 1e-9, "{}", many.width);
        let narrow = Paper { width_mm: Some(88.0), text_pt: 7.0 };
        let problem = Sheet::new(narrow, 40, &names, false).map(|_| ()).unwrap_err().to_string();
        assert!(problem.contains("40 columns") && problem.contains("88 mm"), "{problem}");
    }

    #[test]
    fn insets_stand_below_one_another_within_their_column_and_row() {
        let crops: Vec<Crop> =
            ["0,0,32,32", "100,90,64,20", "200,200,56,56"].map(|crop| crop.parse().unwrap()).into();
        for count in 1..=3 {
            let division = Division::new([256, 256], &crops[..count], 100.0).unwrap();
            let mut free = 0;
            for inset in &division.insets {
                let [width, height] = inset.size(division.line);
                assert!(
                    inset.magnification >= 2 && inset.offset[0] > 256 && inset.offset[1] >= free,
                    "{}",
                    inset.crop
                );
                free = inset.offset[1] + height;
                assert!(free as f64 * division.texel <= division.height + 1e-9, "{} of {count}", inset.crop);
                assert!((inset.offset[0] + width) as f64 * division.texel <= 100.0 + 1e-9, "{}", inset.crop);
            }
            let texel = division.texel * division.scale();
            assert!((texel - texel.round()).abs() < 1e-9 && division.scale() >= PIXELS, "{texel}");
        }
        let one = Division::new([256, 256], &crops[..1], 100.0).unwrap();
        assert_eq!(one.insets[0].magnification, 7, "252 pixels of 32 texels");
        assert!(Division::new([100, 100], &crops[1..2], 100.0).is_err());
    }
}
