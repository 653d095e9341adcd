//! Summary: what `svbrdf rank --dataset` prints, of the losses that are known.

use std::sync::Arc;

use svbrdf_evaluate::dataset::{DatasetReport, DatasetSettings, MaterialResult};

use super::losses::{DatasetLosses, PICK};
use crate::error::Error;
use crate::jobs::answers::{Answered, Answers, Question, Work};
use crate::model::dataset::OpenDataset;

/// The table of the methods over the materials whose losses are known.
#[derive(Clone, Debug)]
pub struct Summarize {
    pub open: Arc<OpenDataset>,
    pub settings: DatasetSettings,
    pub results: Vec<Arc<MaterialResult>>,
    /// That of the results.
    pub generation: u64,
}

impl PartialEq for Summarize {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.open, &other.open) && self.generation == other.generation
    }
}

impl Summarize {
    /// The latest summary of this data set, as soon as there is one.
    pub fn drawn(
        open: &Arc<OpenDataset>,
        losses: &DatasetLosses,
        answers: &Answers,
    ) -> Option<Arc<Answered<DatasetReport>>> {
        let (open, settings, generation) = (open.clone(), losses.settings(open), losses.generation);
        let question = Self { open, settings, results: losses.results().cloned().collect(), generation };
        let ready = (losses.count() > 0).then(|| answers.get(&question))?.ready();
        ready.or_else(|| {
            let latest = answers.latest(|one: &Self| Arc::ptr_eq(&one.open, &question.open));
            latest.map(|(_, report)| report)
        })
    }
}

impl Question for Summarize {
    type Answer = DatasetReport;
    const IS_SHORT: bool = true;
    const KEPT: usize = 1;

    fn answer(&self, _: &Work<'_, Self::Answer>) -> Result<DatasetReport, Error> {
        let results = self.results.iter().map(|one| (**one).clone()).collect();
        Ok(DatasetReport::new(self.settings.clone(), self.open.reading.clone(), results, PICK))
    }
}
