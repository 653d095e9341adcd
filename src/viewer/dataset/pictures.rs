//! Contact sheet: the small materials in sight, read a row at a time and rendered under the light and view of the window.

use std::sync::Arc;

use eframe::egui::{Color32, ColorImage};
use rayon::prelude::*;

use svbrdf_core::material::Material;
use svbrdf_core::model::convention::Convention;
use svbrdf_core::model::scene::Scene;
use svbrdf_core::picture::content::{ColouredDifference, PictureContent, Pictures};
use svbrdf_core::progress::Progress;
use svbrdf_evaluate::registration::in_one_size;
use svbrdf_files::disk::stamp::Stamp;
use svbrdf_files::read::Read;

use crate::error::Error;
use crate::jobs::Shown;
use crate::jobs::answers::{Answered, Pace, Question, Work};
use crate::jobs::watch::Files;
use crate::model::dataset::OpenDataset;
use crate::model::view::ViewState;
use crate::widgets::paint::Atlas;

/// A material in sight, and what was read of it.
pub type ReadCells = (usize, Arc<Answered<ReducedRow>>);

/// The pictures of cells under a light and view.
#[derive(Clone, Debug)]
pub struct DrawCells {
    rows: Vec<ReadCells>,
    scene: Scene,
    convention: Convention,
    exposure_ev: f32,
    content: PictureContent,
}

impl PartialEq for DrawCells {
    fn eq(&self, other: &Self) -> bool {
        let of = |one: &Self| (one.scene, one.convention, one.exposure_ev, one.content);
        let are_same = |(a, b): (&ReadCells, &ReadCells)| a.0 == b.0 && Arc::ptr_eq(&a.1, &b.1);
        let is_long = self.rows.len() == other.rows.len();
        is_long && self.rows.iter().zip(&other.rows).all(are_same) && of(self) == of(other)
    }
}

/// The pictures of all cells, in one.
#[derive(Debug)]
pub struct CellPictures {
    pub atlas: Atlas,
    /// In their order.
    cells: Vec<MatrixCell>,
    /// The difference that has the last colour in all cells, where they show differences.
    pub range: Option<f64>,
}

impl CellPictures {
    /// As [`Atlas::part`], of a cell.
    pub fn part(&self, cell: MatrixCell) -> Option<([[f32; 2]; 2], [usize; 2])> {
        self.atlas.part(self.cells.iter().position(|one| *one == cell)?)
    }
}

impl DrawCells {
    /// These rows in the view of the window. Differences have the range that is set, or the automatic one of all cells.
    pub fn of(rows: Vec<ReadCells>, view: &ViewState) -> Self {
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
pub fn latest(Shown { model, jobs }: Shown<'_>) -> Option<Arc<Answered<CellPictures>>> {
    jobs.answers.latest(&DrawCells::of(Vec::new(), &model.view))
}

impl Question for DrawCells {
    type Answer = CellPictures;
    const PACE: Pace = Pace::AtOnce;
    const KEPT: usize = 1;

    fn is_like(&self, _: &Self) -> bool {
        true
    }

    fn answer(&self, work: &Work<'_, Self::Answer>) -> Result<CellPictures, Error> {
        let row = |row: &ReadCells| self.row(row, work.progress());
        let rows: Vec<Vec<(MatrixCell, Pictures)>> =
            self.rows.par_iter().map(row).collect::<Result<_, _>>()?;
        let all: Vec<(MatrixCell, Pictures)> = rows.into_iter().flatten().collect();
        // All cells share one legend.
        let ranges = all.iter().filter_map(|(_, pictures)| pictures.content.difference?.range);
        let range =
            ranges.fold(None, |most: Option<f64>, range| Some(most.map_or(range, |most| most.max(range))));
        let colours = |(cell, pictures): &(MatrixCell, Pictures)| {
            let difference = pictures.content.difference.map(|one| ColouredDifference { range, ..one });
            let (content, image) =
                (PictureContent { difference, ..pictures.content }, pictures.images.first()?);
            let pixels = image.pixels.iter().map(|rgb| {
                let [r, g, b] = content.colour(*rgb, self.exposure_ev);
                Color32::from_rgb(r, g, b)
            });
            Some((*cell, ColorImage::new([image.width, image.height], pixels.collect())))
        };
        let (cells, pictures): (Vec<_>, Vec<_>) = all.par_iter().filter_map(colours).unzip();
        Ok(CellPictures { atlas: Atlas::new(&pictures), cells, range })
    }
}

impl DrawCells {
    /// The value of the ground truth of a row, and the value or the difference of each prediction, where both have one size.
    fn row(
        &self,
        (case, row): &ReadCells,
        progress: &Progress,
    ) -> Result<Vec<(MatrixCell, Pictures)>, Error> {
        let Some(Ok(truth)) = row.cells.first() else { return Ok(Vec::new()) };
        let value = PictureContent { difference: None, ..self.content };
        let mut all = Vec::new();
        for (column, material) in row.cells.iter().enumerate() {
            let Ok(material) = material else { continue };
            let is_compared = column > 0 && self.content.difference.is_some();
            let (content, materials) = match is_compared {
                true if material.size() == truth.size() => (self.content, vec![&**truth, &**material]),
                true => continue,
                false => (value, vec![&**material]),
            };
            let (scene, ev) = (&self.scene, self.exposure_ev);
            let pictures = content.pictures(&materials, scene, &self.convention, ev, &progress.part())?;
            all.push((MatrixCell { case: *case, column }, pictures));
        }
        Ok(all)
    }
}

/// Longest sides of small materials, in texels.
const SIDES: [usize; 4] = [48, 96, 192, 384];

/// A material of a data set: in column 0 the ground truth, from column 1 on the prediction of a method.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct MatrixCell {
    pub case: usize,
    pub column: usize,
}

/// A small material, or why there is none.
pub type Reduced = Result<Arc<Material<f32>>, String>;

/// The ground truth of a material and its predictions, small, and the files of them.
#[derive(Debug)]
pub struct ReducedRow {
    pub cells: Vec<Reduced>,
    pub files: Files,
}

/// The small ground truth of a material, and the predictions of all methods.
#[derive(Clone, Debug)]
pub struct ReadRow {
    open: Arc<OpenDataset>,
    case: usize,
    /// Longest side, in texels.
    side: usize,
    version: u64,
}

impl PartialEq for ReadRow {
    fn eq(&self, other: &Self) -> bool {
        let of = |one: &Self| (Arc::as_ptr(&one.open).addr(), one.case, one.side, one.version);
        of(self) == of(other)
    }
}

impl ReadRow {
    /// The row of a material that is drawn with this longest side in pixels, after its files were read again so often.
    pub fn of(open: &Arc<OpenDataset>, case: usize, pixels: usize, version: u64) -> Self {
        let side = SIDES.into_iter().find(|side| *side >= pixels).unwrap_or(SIDES[SIDES.len() - 1]);
        Self { open: open.clone(), case, side, version }
    }

    fn read(&self, column: usize, progress: &Progress) -> Result<(Material<f32>, Files), String> {
        let source = self.open.source(self.case, column)?;
        let read: Read<f32> = source.read(&progress.part()).map_err(|error| error.to_string())?;
        let files = read.files.into_iter().map(|path| (path.clone(), Stamp::of(&path)));
        Ok((read.material, files.collect()))
    }

    /// Brings a row to one size, as in the panes.
    fn register(&self, cells: &mut [Result<Material<f32>, String>]) {
        let [Ok(truth), predictions @ ..] = cells else { return };
        let ways = (1..).map(|column| self.open.registration(column));
        let all: Vec<_> = predictions.iter().map(|one| one.as_ref().ok()).zip(ways).collect();
        let Some(Ok((cut, changed))) = in_one_size(truth, &all) else { return };
        *truth = cut;
        for (one, changed) in predictions.iter_mut().zip(changed) {
            if let Some(changed) = changed {
                *one = changed.map_err(|error| error.to_string());
            }
        }
    }

    fn small(&self, material: Material<f32>) -> Result<Material<f32>, String> {
        let size = material.size();
        let (longest, side) = (size[0].max(size[1]), self.side);
        let small = size.map(|length| if longest > side { (length * side / longest).max(1) } else { length });
        material.resized(small).map_err(|error| error.to_string())
    }
}

impl Question for ReadRow {
    type Answer = ReducedRow;
    const PACE: Pace = Pace::AtOnce;
    const KEPT: usize = 32;

    fn answer(&self, work: &Work<'_, Self::Answer>) -> Result<Self::Answer, Error> {
        // What is registered is brought to one size first.
        let is_registered = !self.open.reading.registrations.is_empty();
        let of = |column: usize| match self.read(column, work.progress()) {
            Ok((material, files)) if is_registered => (Ok(material), files),
            Ok((material, files)) => (self.small(material), files),
            Err(problem) => (Err(problem), Files::new()),
        };
        let columns = (0..=self.open.methods().len()).into_par_iter();
        let (mut cells, files): (Vec<_>, Vec<Files>) = columns.map(of).unzip();
        if is_registered {
            self.register(&mut cells);
            cells = cells.into_par_iter().map(|one| self.small(one?)).collect();
        }
        let cells = cells.into_iter().map(|one| one.map(Arc::new)).collect();
        Ok(ReducedRow { cells, files: files.concat() })
    }
}
