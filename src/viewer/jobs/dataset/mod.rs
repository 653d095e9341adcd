//! Work for a data set: the losses of all materials, the materials in the window and those ahead, small materials, the summary.

pub mod cases;
pub mod cells;
pub mod losses;
pub mod sheet;
pub mod summary;

use std::sync::Arc;

use svbrdf_gpu::Gpu;

use super::work::waker::Waker;
use crate::error::Error;
use crate::jobs::answers::Answers;
use crate::model::Model;
use crate::model::dataset::OpenDataset;
use crate::model::material::read::MaterialId;
use cases::ReadCases;
use losses::DatasetLosses;

/// The work for the data set of the window.
#[derive(Debug, Default)]
pub struct DatasetJobs {
    /// The data set that everything else is of.
    of: Option<Arc<OpenDataset>>,
    pub losses: DatasetLosses,
    /// The materials that are there, the first the one that was asked for.
    pub cases: ReadCases,
    /// The latest that were there, of which others take what they have in common.
    known: ReadCases,
}

impl DatasetJobs {
    /// Computes everything again.
    pub fn restart(&mut self) {
        let read_again = self.losses.read_again + 1;
        *self = Self::default();
        self.losses.read_again = read_again;
    }

    /// Drops the materials that are there: files have changed.
    pub fn forget_cases(&mut self) {
        (self.cases, self.known) = Default::default();
    }

    /// Whether the maps of a material stay on the adapter.
    pub fn hold(&self, id: MaterialId) -> bool {
        self.cases.iter().flat_map(|case| &case.materials).any(|(_, one)| one.id == id)
    }

    /// Takes over results, and computes what is displayed of the materials `in_sight`, then the rest.
    pub fn follow(
        &mut self,
        (waker, answers): (&Waker, &Answers),
        gpu: Option<&Gpu>,
        model: &Model,
        in_sight: &[usize],
    ) -> Option<Error> {
        let of = &model.dataset.open;
        if self.of.as_ref().map(Arc::as_ptr) != of.as_ref().map(Arc::as_ptr) {
            self.restart();
            self.of.clone_from(of);
        }
        self.cases = cases::ask(answers, gpu, model, (self.losses.read_again, &self.known));
        if !self.cases.is_empty() {
            self.known.clone_from(&self.cases);
        }
        let first: Vec<usize> =
            std::iter::once(model.dataset.wanted).chain(in_sight.iter().copied()).collect();
        self.losses.follow(waker, of.as_ref()?, &model.view.convention, &first)
    }
}
