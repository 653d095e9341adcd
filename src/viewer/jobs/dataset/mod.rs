//! Work for a data set: the losses of all materials, the materials in the window and those ahead, small materials, the summary.

pub mod cases;
pub mod cells;
pub mod losses;
pub mod sheet;
pub mod summary;

use std::sync::Arc;

use svbrdf_gpu::Gpu;

use super::work::job::Job;
use super::work::waker::Waker;
use crate::error::Error;
use crate::jobs::answers::{Answered, Answers};
use crate::model::Model;
use crate::model::dataset::{DatasetState, OpenDataset};
use cases::CaseJobs;
use cells::{Cell, CellJobs};
use losses::DatasetLosses;
use sheet::{DrawSheet, SheetPicture};

/// The work for the data set of the window.
#[derive(Debug, Default)]
pub struct DatasetJobs {
    /// The data set that is being matched.
    pub opening: Option<Job<DatasetState>>,
    /// The data set that everything else is of.
    of: Option<Arc<OpenDataset>>,
    pub losses: DatasetLosses,
    pub cases: CaseJobs,
    pub cells: CellJobs,
    /// The latest pictures of the cells in sight.
    pub sheet: Option<Arc<Answered<SheetPicture>>>,
}

/// What the window displays of a data set.
#[derive(Clone, Debug, Default)]
pub struct DisplayedCases {
    /// The materials that are in sight.
    pub cases: Vec<usize>,
    /// The small pictures that are in sight, and the longest side in pixels that they are drawn with.
    pub cells: Vec<Cell>,
    pub pixels: usize,
}

impl DatasetJobs {
    /// The difference that has the last colour in the cells in sight.
    pub fn range(&self) -> Option<f64> {
        self.sheet.as_ref().and_then(|sheet| sheet.range)
    }

    /// Computes everything again.
    pub fn restart(&mut self) {
        *self = Self { opening: self.opening.take(), ..Self::default() };
    }

    /// Takes over results, and computes what is displayed, then the rest.
    pub fn follow(
        &mut self,
        (waker, answers): (&Waker, &Answers),
        gpu: Option<&Gpu>,
        model: &Model,
        displayed: &DisplayedCases,
    ) -> Vec<Error> {
        let Some(open) = &model.dataset.open else {
            if self.of.is_some() {
                self.restart();
            }
            return Vec::new();
        };
        if self.of.as_ref().is_none_or(|of| !Arc::ptr_eq(of, open)) {
            self.restart();
            self.of = Some(open.clone());
        }
        let wanted: Vec<usize> =
            std::iter::once(model.dataset.wanted).chain(model.dataset.ahead.iter().copied()).collect();
        let first: Vec<usize> = wanted[..1].iter().chain(&displayed.cases).copied().collect();
        let errors = [
            self.losses.follow(waker, open, &model.view.convention, &first),
            self.cases.follow(waker, gpu, open, model.materials.rules, (&wanted, &model.dataset.pinned())),
            self.cells.follow(waker, open, &displayed.cells, displayed.pixels),
        ];
        let wanted = DrawSheet::of(&self.cells, &displayed.cells, &model.view);
        self.sheet = wanted.and_then(|wanted| answers.get(&wanted).ready().or(self.sheet.take()));
        errors.into_iter().flatten().collect()
    }
}
