//! Summary: what `svbrdf rank --dataset` prints, of the losses that are known.

use std::sync::Arc;

use svbrdf_evaluate::dataset::{DatasetReport, MaterialResult};

use super::losses::{DatasetLosses, PICK};
use crate::error::Error;
use crate::jobs::work::job::Job;
use crate::jobs::work::latest::Latest;
use crate::jobs::work::waker::Waker;
use crate::model::dataset::OpenDataset;

/// The latest summary.
#[derive(Debug, Default)]
pub struct SummaryJob(Latest<u64, Arc<DatasetReport>>);

impl SummaryJob {
    pub fn get(&self) -> Option<&Arc<DatasetReport>> {
        self.0.get().map(|(_, report)| report)
    }

    /// Takes over the summary, and makes that of the losses of now, where it is in sight.
    pub(super) fn follow(
        &mut self,
        waker: &Waker,
        open: &Arc<OpenDataset>,
        losses: &DatasetLosses,
        is_open: bool,
    ) -> Option<Error> {
        if !is_open || losses.count() == 0 {
            return None;
        }
        self.0.follow(Some(losses.generation), |_| {
            let (settings, reading) = (losses.settings(open), open.reading.clone());
            let results: Vec<Arc<MaterialResult>> = losses.results().cloned().collect();
            Job::start(waker, move |_| {
                let results = results.iter().map(|one| (**one).clone()).collect();
                Ok(Arc::new(DatasetReport::new(settings, reading, results, PICK)))
            })
        })
    }
}
