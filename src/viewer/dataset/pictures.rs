//! Contact sheet: the small materials in sight, rendered under the light and view of the window.

use std::sync::Arc;

use rayon::prelude::*;

use svbrdf_core::model::convention::Convention;
use svbrdf_core::model::scene::Scene;
use svbrdf_core::picture::content::{ColouredDifference, PictureContent, Pictures};
use svbrdf_core::progress::Progress;

use crate::dataset::cells::{Reduced, SheetCell};
use crate::error::Error;
use crate::jobs::Shown;
use crate::jobs::answers::{Answered, Pace, Question, Work};
use crate::jobs::work::picture::{Atlas, PanelPicture};
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
    pub atlas: Atlas,
    /// In their order.
    cells: Vec<SheetCell>,
    /// The difference that has the last colour in all cells, where they show differences.
    pub range: Option<f64>,
}

impl SheetPicture {
    /// As [`Atlas::part`], of a cell.
    pub fn part(&self, cell: SheetCell) -> Option<([[f32; 2]; 2], [usize; 2])> {
        self.atlas.part(self.cells.iter().position(|one| *one == cell)?)
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
}

/// The latest pictures.
pub fn latest(Shown { model, jobs }: Shown<'_>) -> Option<Arc<Answered<SheetPicture>>> {
    jobs.answers.latest(&DrawSheet::of(Vec::new(), &model.view))
}

impl Question for DrawSheet {
    type Answer = SheetPicture;
    const PACE: Pace = Pace::AtOnce;
    const KEPT: usize = 1;

    fn is_like(&self, _: &Self) -> bool {
        true
    }

    fn answer(&self, work: &Work<'_, Self::Answer>) -> Result<SheetPicture, Error> {
        let row = |row: &SheetRow| self.row(row, work.progress());
        let rows: Vec<Vec<(SheetCell, Pictures)>> =
            self.rows.par_iter().map(row).collect::<Result<_, _>>()?;
        let all: Vec<(SheetCell, Pictures)> = rows.into_iter().flatten().collect();
        // All cells share one legend.
        let ranges = all.iter().filter_map(|(_, pictures)| pictures.content.difference?.range);
        let range =
            ranges.fold(None, |most: Option<f64>, range| Some(most.map_or(range, |most| most.max(range))));
        let colours = |(cell, pictures): &(SheetCell, Pictures)| {
            let difference = pictures.content.difference.map(|one| ColouredDifference { range, ..one });
            let (content, image) =
                (PictureContent { difference, ..pictures.content }, pictures.images.first()?);
            let pixels =
                image.pixels.iter().map(|rgb| PanelPicture::opaque(content.colour(*rgb, self.exposure_ev)));
            Some((*cell, PanelPicture { size: [image.width, image.height], pixels: pixels.collect() }))
        };
        let (cells, pictures): (Vec<_>, Vec<_>) = all.par_iter().filter_map(colours).unzip();
        Ok(SheetPicture { atlas: Atlas::new(&pictures), cells, range })
    }
}

impl DrawSheet {
    /// The value of the ground truth of a row, and the value or the difference of each prediction, where both have one size.
    fn row(&self, (case, row): &SheetRow, progress: &Progress) -> Result<Vec<(SheetCell, Pictures)>, Error> {
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
            all.push((SheetCell { case: *case, column }, pictures));
        }
        Ok(all)
    }
}
