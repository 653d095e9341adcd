//! Jobs of the tab *Why*: where and by what the predictions are wrong.

pub mod attribution;
pub mod diagnosis;
pub mod one_by_one;
pub mod pair;
pub mod scenes;
pub mod search;
pub mod tables;
pub mod thumbnails;

use svbrdf_core::loss::Request;
use svbrdf_evaluate::why::Worst;

use crate::error::Error;
use crate::jobs::why::attribution::attributed;
use crate::jobs::work::context::JobContext;
use crate::model::settings::{WhySection, WhySections};

pub use attribution::{ATTRIBUTION_TARGET, Attributed, AttributionJob};
pub use diagnosis::{Diagnosed, DiagnosisJob};
pub use pair::ComparedPair;
pub use scenes::ScenesJob;
pub use search::SearchJob;
pub use tables::{AnalysisTable, TableJobs};
pub use thumbnails::{MOST as MOST_THUMBNAILS, Thumbnails};

/// What the results depend on besides the pair and the scene.
#[derive(Clone, Debug, PartialEq)]
pub struct WhyQuery {
    /// The unfolded sections.
    pub sections: WhySections,
    /// The scenes that are listed.
    pub scenes: Request,
    /// Seeds the scenes of the attribution and the diagnosis.
    pub seed: u64,
}

/// The jobs of the tab.
#[derive(Debug, Default)]
pub struct WhyJobs {
    pub diagnosis: DiagnosisJob,
    pub attribution: AttributionJob,
    pub scenes: ScenesJob,
    pub search: SearchJob,
    pub tables: TableJobs,
}

impl WhyJobs {
    /// Takes over results, and computes what is wanted now; nothing new where the tab is not `displayed`.
    pub fn follow(&mut self, work: &JobContext<'_>, displayed: bool, query: WhyQuery) -> Vec<Error> {
        let pairs = ComparedPair::all(work.materials, work.view);
        let (waker, chosen) = (work.waker, work.view.display.prediction);
        let is_open = |section| displayed && query.sections.is_open(section);
        let diagnoses = is_open(WhySection::Diagnosis);
        let error = self.diagnosis.follow(waker, diagnoses, (&pairs, chosen), query.seed);
        // The tab is read from above: what takes longer than its first line does not share the processors with it.
        let awaits_first =
            diagnoses && pairs.get(chosen).is_some_and(|pair| self.diagnosis.awaits(pair, query.seed));
        let is_next = |section| is_open(section) && !awaits_first;
        let errors = [
            error,
            self.attribution.follow(
                waker,
                is_next(WhySection::Maps),
                (&pairs, chosen),
                query.seed,
                attributed,
            ),
            self.tables.follow(
                waker,
                |name| is_next(WhySection::Table(name)),
                (&pairs, chosen),
                &query.scenes,
            ),
            self.scenes.follow(waker, is_next(WhySection::Scenes), pairs.get(chosen), query.scenes),
        ];
        errors.into_iter().flatten().collect()
    }

    /// Takes over the result of the search for the worst scene, once.
    pub fn poll_search(&mut self, work: &JobContext<'_>) -> Option<Result<Worst, Error>> {
        self.search.poll(ComparedPair::of(work.materials, work.view).as_ref())
    }
}
