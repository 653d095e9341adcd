//! Contact sheet: the small materials in sight, rendered under the light and view of the window.

use std::collections::HashMap;
use std::sync::Arc;

use rayon::prelude::*;

use svbrdf_core::model::convention::Convention;
use svbrdf_core::model::scene::Scene;
use svbrdf_core::picture::content::{ColouredDifference, PictureContent, Pictures};
use svbrdf_core::progress::Progress;

use super::cells::{Cell, Reduced};
use crate::error::Error;
use crate::jobs::answers::{Answered, Answers, Question, Work};
use crate::jobs::work::picture::Picture;
use crate::model::view::ViewState;

/// A material in sight, and what was read of it.
pub type SheetRow = (usize, Arc<Answered<Vec<Reduced>>>);

/// The pictures of cells under a light and view.
#[derive(Clone, Debug)]
pub struct DrawSheet {
    rows: Vec<SheetRow>,
    scene: Scene,
    convention: Convention,
    exposure_ev: f32,
    content: PictureContent,
}

impl PartialEq for DrawSheet {
    fn eq(&self, other: &Self) -> bool {
        let of = |one: &Self| (one.scene, one.convention, one.exposure_ev, one.content);
        let are_same = |(a, b): (&SheetRow, &SheetRow)| a.0 == b.0 && Arc::ptr_eq(&a.1, &b.1);
        let is_long = self.rows.len() == other.rows.len();
        is_long && self.rows.iter().zip(&other.rows).all(are_same) && of(self) == of(other)
    }
}

/// The pictures of all cells, in one.
#[derive(Debug)]
pub struct SheetPicture {
    pub picture: Arc<Picture>,
    parts: HashMap<Cell, [[usize; 2]; 2]>,
    /// The difference that has the last colour in all cells, where they show differences.
    pub range: Option<f64>,
}

impl SheetPicture {
    /// The part that is the picture of a cell: least and greatest x and y, as shares of its sides; and its size in pixels.
    pub fn part(&self, cell: Cell) -> Option<([[f32; 2]; 2], [usize; 2])> {
        let [least, size] = self.parts.get(&cell)?;
        let share = |at: [usize; 2]| [0, 1].map(|axis| at[axis] as f32 / self.picture.size[axis] as f32);
        Some(([share(*least), share([least[0] + size[0], least[1] + size[1]])], *size))
    }
}

impl DrawSheet {
    /// These rows in the view of the window. Differences have the range that is set, or the automatic one of all cells.
    pub fn of(rows: Vec<SheetRow>, view: &ViewState) -> Self {
        let quantity = view.display.quantity;
        let (kind, _) = view.display.differences.pointwise(quantity);
        let range = view.display.differences.range(quantity);
        let difference = view.display.difference.then_some(ColouredDifference { kind, range });
        Self {
            rows,
            scene: view.scene,
            convention: view.convention(),
            exposure_ev: view.exposure_ev,
            content: PictureContent { quantity, difference },
        }
    }

    /// The pictures, or the latest ones while these are drawn.
    pub fn drawn(&self, answers: &Answers) -> Option<Arc<Answered<SheetPicture>>> {
        answers.get(self).ready().or_else(|| Self::latest(answers))
    }

    /// The latest pictures.
    pub fn latest(answers: &Answers) -> Option<Arc<Answered<SheetPicture>>> {
        answers.latest(|_: &Self| true).map(|(_, drawn)| drawn)
    }
}

impl Question for DrawSheet {
    type Answer = SheetPicture;
    const IS_SHORT: bool = true;
    const KEPT: usize = 1;

    fn answer(&self, work: &Work<'_, Self::Answer>) -> Result<SheetPicture, Error> {
        let row = |row: &SheetRow| self.row(row, work.progress());
        let rows: Vec<Vec<(Cell, Pictures)>> = self.rows.par_iter().map(row).collect::<Result<_, _>>()?;
        let all: Vec<(Cell, Pictures)> = rows.into_iter().flatten().collect();
        // All cells share one legend.
        let ranges = all.iter().filter_map(|(_, pictures)| pictures.content.difference?.range);
        let range =
            ranges.fold(None, |most: Option<f64>, range| Some(most.map_or(range, |most| most.max(range))));
        let colours = |(cell, pictures): &(Cell, Pictures)| {
            let difference = pictures.content.difference.map(|one| ColouredDifference { range, ..one });
            let (content, image) =
                (PictureContent { difference, ..pictures.content }, pictures.images.first()?);
            let pixels =
                image.pixels.iter().map(|rgb| Picture::opaque(content.colour(*rgb, self.exposure_ev)));
            Some((*cell, Picture { size: [image.width, image.height], pixels: pixels.collect() }))
        };
        let pictures: Vec<(Cell, Picture)> = all.par_iter().filter_map(colours).collect();
        Ok(SheetPicture { range, ..together(&pictures) })
    }
}

impl DrawSheet {
    /// The value of the ground truth of a row, and the value or the difference of each prediction, where both have one size.
    fn row(&self, (case, row): &SheetRow, progress: &Progress) -> Result<Vec<(Cell, Pictures)>, Error> {
        let Some(Ok(truth)) = row.first() else { return Ok(Vec::new()) };
        let value = PictureContent { difference: None, ..self.content };
        let mut all = Vec::new();
        for (column, material) in row.iter().enumerate() {
            let Ok(material) = material else { continue };
            let is_compared = column > 0 && self.content.difference.is_some();
            let (content, materials) = match is_compared {
                true if material.size() == truth.size() => (self.content, vec![&**truth, &**material]),
                true => continue,
                false => (value, vec![&**material]),
            };
            let (scene, ev) = (&self.scene, self.exposure_ev);
            let pictures = content.pictures(&materials, scene, &self.convention, ev, &progress.part())?;
            all.push((Cell { case: *case, column }, pictures));
        }
        Ok(all)
    }
}

/// All pictures in one, in cells of the size of the largest.
fn together(pictures: &[(Cell, Picture)]) -> SheetPicture {
    let side = |axis: usize| pictures.iter().map(|(_, one)| one.size[axis]).max().unwrap_or(1);
    let columns = (pictures.len() as f64).sqrt().ceil().max(1.0) as usize;
    let sides = [side(0), side(1)];
    let size = [columns * sides[0], pictures.len().div_ceil(columns).max(1) * sides[1]];
    let mut picture = Picture { size, pixels: vec![Picture::TRANSPARENT; size[0] * size[1]] };
    let mut parts = HashMap::new();
    for (index, (cell, one)) in pictures.iter().enumerate() {
        let least = [index % columns * sides[0], index / columns * sides[1]];
        for (row, line) in one.pixels.chunks(one.size[0].max(1)).enumerate() {
            let start = (least[1] + row) * size[0] + least[0];
            picture.pixels[start..start + line.len()].copy_from_slice(line);
        }
        parts.insert(*cell, [least, one.size]);
    }
    SheetPicture { picture: Arc::new(picture), parts, range: None }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_part_of_the_picture_is_that_of_its_cell() {
        let cell = |case| Cell { case, column: 1 };
        let one = |shade: u8, size: [usize; 2]| {
            (cell(shade.into()), Picture { size, pixels: vec![[shade, 0, 0, 255]; size[0] * size[1]] })
        };
        let sheet = together(&[one(1, [3, 2]), one(2, [2, 3]), one(3, [3, 3]), one(4, [1, 1])]);
        assert_eq!(sheet.picture.size, [6, 6]);
        assert!(sheet.part(cell(5)).is_none());
        for shade in 1..5 {
            let ([least, most], size) = sheet.part(cell(shade.into())).unwrap();
            let [first, last] = [least, most].map(|at| [0, 1].map(|axis| (at[axis] * 6.0).round() as usize));
            assert_eq!([last[0] - first[0], last[1] - first[1]], size);
            let shades = (first[1]..last[1]).flat_map(|y| (first[0]..last[0]).map(move |x| [x, y]));
            assert!(shades.into_iter().all(|[x, y]| sheet.picture.pixels[y * 6 + x][0] == shade), "{shade}");
        }
    }
}
