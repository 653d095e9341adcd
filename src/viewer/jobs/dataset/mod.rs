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
use crate::model::Model;
use crate::model::dataset::{DatasetState, OpenDataset};
use cases::CaseJobs;
use losses::DatasetLosses;

/// The work for the data set of the window.
#[derive(Debug, Default)]
pub struct DatasetJobs {
    /// The data set that is being matched.
    pub opening: Option<Job<DatasetState>>,
    /// The data set that everything else is of.
    of: Option<Arc<OpenDataset>>,
    pub losses: DatasetLosses,
    pub cases: CaseJobs,
}

impl DatasetJobs {
    /// Computes everything again.
    pub fn restart(&mut self) {
        let (opening, read_again) = (self.opening.take(), self.losses.read_again + 1);
        *self = Self { opening, ..Self::default() };
        self.losses.read_again = read_again;
    }

    /// Takes over results, and computes what is displayed of the materials `in_sight`, then the rest.
    pub fn follow(
        &mut self,
        waker: &Waker,
        gpu: Option<&Gpu>,
        model: &Model,
        in_sight: &[usize],
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
        let first: Vec<usize> = wanted[..1].iter().chain(in_sight).copied().collect();
        let errors = [
            self.losses.follow(waker, open, &model.view.convention, &first),
            self.cases.follow(waker, gpu, open, model.materials.rules, (&wanted, &model.dataset.pinned())),
        ];
        errors.into_iter().flatten().collect()
    }
}
