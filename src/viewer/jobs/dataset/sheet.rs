//! Contact sheet: the small materials in sight, rendered under the light and view of the window.

use std::collections::HashMap;
use std::sync::Arc;

use rayon::prelude::*;

use svbrdf_core::image::Image;
use svbrdf_core::material::Material;
use svbrdf_core::model::convention::Convention;
use svbrdf_core::model::scene::Scene;
use svbrdf_core::picture::content::{ColouredDifference, PictureContent};
use svbrdf_core::picture::difference::DifferenceParams;
use svbrdf_core::picture::statistics::Distributions;
use svbrdf_core::progress::Progress;

use super::cells::{Cell, CellJobs};
use crate::error::Error;
use crate::jobs::answers::content::Given;
use crate::jobs::answers::{Question, Work};
use crate::jobs::work::picture::Picture;
use crate::model::view::ViewState;

/// The pictures of cells under a light and view.
#[derive(Clone, Debug, PartialEq)]
pub struct DrawSheet {
    cells: Vec<Cell>,
    /// That of the small materials.
    generation: u64,
    scene: Scene,
    convention: Convention,
    exposure_ev: f32,
    content: PictureContent,
    materials: Given<HashMap<Cell, Arc<Material<f32>>>>,
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
    /// The small materials in sight, where there are some, in the view of the window. Differences have the range that is set, or the
    /// automatic one of all cells.
    pub fn of(cells: &CellJobs, in_sight: &[Cell], view: &ViewState) -> Option<Self> {
        let quantity = view.display.quantity;
        let (kind, _) = view.display.differences.pointwise(quantity);
        let range = view.display.differences.range(quantity);
        let difference = view.display.difference.then_some(ColouredDifference { kind, range });
        // Differences are from the ground truth, whether it is in sight or not.
        let truths = in_sight.iter().map(|cell| Cell { column: 0, ..*cell });
        let of = |cell: Cell| Some((cell, cells.get(cell)?.as_ref().ok()?.clone()));
        let materials = in_sight.iter().copied().chain(truths).filter_map(of).collect();
        (!in_sight.is_empty()).then(|| Self {
            cells: in_sight.to_vec(),
            generation: cells.generation,
            scene: view.scene,
            convention: view.convention(),
            exposure_ev: view.exposure_ev,
            content: PictureContent { quantity, difference },
            materials: Given(materials),
        })
    }
}

impl Question for DrawSheet {
    type Answer = SheetPicture;
    const IS_SHORT: bool = true;
    const KEPT: usize = 1;

    fn answer(&self, work: &Work<'_, Self::Answer>) -> Result<SheetPicture, Error> {
        render(self, &self.materials.0, work.progress())
    }
}

fn render(
    key: &DrawSheet,
    materials: &HashMap<Cell, Arc<Material<f32>>>,
    progress: &Progress,
) -> Result<SheetPicture, Error> {
    let image = |cell: &Cell| match materials.get(cell) {
        Some(material) => {
            let quantity = key.content.quantity;
            quantity.image(material, &key.scene, &key.convention, &progress.part()).map(Some)
        }
        None => Ok(None),
    };
    let values: Vec<Option<Image<f32>>> = key.cells.par_iter().map(image).collect::<Result<_, _>>()?;
    let truths: HashMap<usize, &Image<f32>> = key
        .cells
        .iter()
        .zip(&values)
        .filter(|(cell, _)| cell.column == 0)
        .filter_map(|(cell, image)| Some((cell.case, image.as_ref()?)))
        .collect();
    let params = DifferenceParams { epsilon: key.convention.epsilon, exposure_ev: key.exposure_ev };
    let key = &DrawSheet { content: with_range(key, &values, &truths, params), ..key.clone() };
    let picture =
        |(cell, image): (&Cell, &Option<Image<f32>>)| colours(key, *cell, image.as_ref()?, &truths, params);
    let pictures: Vec<Option<Picture>> = key.cells.par_iter().zip(&values).map(picture).collect();
    let range = key.content.difference.and_then(|difference| difference.range);
    Ok(SheetPicture { range, ..together(&key.cells, pictures) })
}

/// The content with the automatic range of all cells, where none is set: they share one legend.
fn with_range(
    key: &DrawSheet,
    values: &[Option<Image<f32>>],
    truths: &HashMap<usize, &Image<f32>>,
    params: DifferenceParams,
) -> PictureContent {
    let Some(difference) = key.content.difference.filter(|one| one.range.is_none()) else {
        return key.content;
    };
    let of = |(cell, image): (&Cell, &Option<Image<f32>>)| {
        let (truth, image) = (truths.get(&cell.case)?, image.as_ref().filter(|_| cell.column > 0)?);
        let is_of_size = (truth.width, truth.height) == (image.width, image.height);
        is_of_size.then(|| difference.kind.of_images(truth, image, params))
    };
    let all: Vec<_> = key.cells.par_iter().zip(values).filter_map(of).collect();
    let range = Some(Distributions::of(&all, difference.kind.is_signed()).auto_range);
    PictureContent { difference: Some(ColouredDifference { range, ..difference }), ..key.content }
}

/// The colours of a cell: the value of the ground truth, and the value or the difference of a prediction, where both have one size.
fn colours(
    key: &DrawSheet,
    cell: Cell,
    image: &Image<f32>,
    truths: &HashMap<usize, &Image<f32>>,
    params: DifferenceParams,
) -> Option<Picture> {
    let value = PictureContent { difference: None, ..key.content };
    let (content, difference) = match key.content.difference.filter(|_| cell.column > 0) {
        None => (value, None),
        Some(difference) => {
            let truth = truths.get(&cell.case)?;
            let is_of_size = (truth.width, truth.height) == (image.width, image.height);
            (key.content, Some(is_of_size.then(|| difference.kind.picture(truth, image, params))?))
        }
    };
    let shown = difference.as_ref().unwrap_or(image);
    let pixels = shown.pixels.iter().map(|rgb| Picture::opaque(content.colour(*rgb, key.exposure_ev)));
    Some(Picture { size: [shown.width, shown.height], pixels: pixels.collect() })
}

/// All pictures in one, in cells of the size of the largest.
fn together(cells: &[Cell], pictures: Vec<Option<Picture>>) -> SheetPicture {
    let all = || pictures.iter().flatten();
    let side = |axis: usize| all().map(|one| one.size[axis]).max().unwrap_or(1);
    let (sides, columns) = ([side(0), side(1)], (all().count() as f64).sqrt().ceil().max(1.0) as usize);
    let size = [columns * sides[0], all().count().div_ceil(columns).max(1) * sides[1]];
    let mut picture = Picture { size, pixels: vec![Picture::TRANSPARENT; size[0] * size[1]] };
    let mut parts = HashMap::new();
    let found = cells.iter().zip(&pictures).filter_map(|(cell, one)| Some((cell, one.as_ref()?)));
    for (index, (cell, one)) in found.enumerate() {
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
        let cells: Vec<Cell> = (0..5).map(|case| Cell { case, column: 1 }).collect();
        let one = |shade: u8, size: [usize; 2]| {
            Some(Picture { size, pixels: vec![[shade, 0, 0, 255]; size[0] * size[1]] })
        };
        let pictures = vec![one(1, [3, 2]), None, one(2, [2, 3]), one(3, [3, 3]), one(4, [1, 1])];
        let sheet = together(&cells, pictures);
        assert_eq!(sheet.picture.size, [6, 6]);
        assert!(sheet.part(cells[1]).is_none());
        for (cell, shade) in [(0, 1), (2, 2), (3, 3), (4, 4)] {
            let ([least, most], size) = sheet.part(cells[cell]).unwrap();
            let [first, last] = [least, most].map(|at| [0, 1].map(|axis| (at[axis] * 6.0).round() as usize));
            assert_eq!([last[0] - first[0], last[1] - first[1]], size);
            let shades = (first[1]..last[1]).flat_map(|y| (first[0]..last[0]).map(move |x| [x, y]));
            assert!(shades.into_iter().all(|[x, y]| sheet.picture.pixels[y * 6 + x][0] == shade), "{cell}");
        }
    }
}
