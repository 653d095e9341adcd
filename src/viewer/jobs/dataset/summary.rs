//! Summary: what `svbrdf rank --dataset` prints, of the losses that are known; whether the order survives other questions.

use std::sync::Arc;

use svbrdf_core::progress::Progress;
use svbrdf_evaluate::dataset::{self, DatasetReport, MaterialResult};
use svbrdf_files::convention::ChosenConvention;

use super::losses::{DatasetLosses, PICK};
use crate::error::Error;
use crate::jobs::work::job::Job;
use crate::jobs::work::latest::Latest;
use crate::jobs::work::order::OrderJob;
use crate::jobs::work::priority;
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

/// What the order of the methods depends on: the convention, and how often a material was read again.
pub type DatasetOrderKey = (ChosenConvention, u64);

/// Asks whether the order of the methods survives, as `svbrdf rank --dataset --robust` does, where that is in sight.
pub(super) fn follow_order(
    order: &mut OrderJob<DatasetOrderKey>,
    waker: &Waker,
    open: &Arc<OpenDataset>,
    losses: &DatasetLosses,
    is_open: bool,
) -> Option<Error> {
    let settings = losses.settings(open);
    let key = (settings.convention.clone(), losses.read_again);
    order.follow(waker, (is_open && open.methods().len() > 1).then_some(key), |_| {
        let open = open.clone();
        move |progress: &Progress| {
            // Threads of its own, as for the losses.
            let pool = priority::background_pool().map_err(|error| Error::internal(error.to_string()))?;
            pool.install(|| Ok(dataset::robust(&open.cases, &settings, &open.reading, |_| (), progress)?))
        }
    })
}
