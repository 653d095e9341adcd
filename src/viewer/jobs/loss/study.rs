//! Study of speed against accuracy for the chosen pair, updated as it grows.

use svbrdf_core::model::convention::Convention;
use svbrdf_core::progress::Progress;
use svbrdf_evaluate::study::{self, Pair, Study};

use crate::error::Error;
use crate::jobs::work::job::Job;
use crate::jobs::work::waker::Waker;
use crate::model::material::list::MaterialList;
use crate::model::material::read::MaterialId;

/// What a study depends on: the ids of ground truth and prediction, and the convention.
type StudyKey = ([MaterialId; 2], Convention);

/// The running study, and the results of it or of an earlier one.
#[derive(Debug, Default)]
pub struct StudyJob {
    running: Option<RunningStudy>,
    measured: Option<Measured>,
}

/// The measurements, complete or so far.
#[derive(Debug)]
struct Measured {
    key: StudyKey,
    study: Study,
    complete: bool,
}

#[derive(Debug)]
struct RunningStudy {
    key: StudyKey,
    job: Job<Study, Study>,
}

impl StudyJob {
    /// What has been measured, and whether it is of the current materials.
    pub fn measured(
        &self,
        materials: &MaterialList,
        prediction: usize,
        convention: &Convention,
    ) -> Option<(&Study, bool)> {
        let now = key(materials, prediction, convention);
        self.measured.as_ref().map(|measured| (&measured.study, Some(measured.key) == now))
    }

    /// The running study, for its progress.
    pub fn job(&self) -> Option<&Job<Study, Study>> {
        self.running.as_ref().map(|running| &running.job)
    }

    /// Starts to measure `prediction` against the ground truth, unless that is done or running.
    pub fn ensure(
        &mut self,
        waker: &Waker,
        materials: &MaterialList,
        prediction: usize,
        convention: &Convention,
    ) {
        let now = key(materials, prediction, convention);
        let known = [
            self.running.as_ref().map(|r| r.key),
            self.measured.as_ref().filter(|measured| measured.complete).map(|measured| measured.key),
        ];
        if !known.contains(&now) {
            self.start(waker, materials, prediction, convention);
        }
    }

    /// Starts to measure; a running study is cancelled.
    pub fn start(
        &mut self,
        waker: &Waker,
        materials: &MaterialList,
        prediction: usize,
        convention: &Convention,
    ) {
        self.running = None;
        let Some(key) = key(materials, prediction, convention) else { return };
        let [ground_truth, prediction] = [0, prediction + 1].map(|index| materials.all[index].read.clone());
        let convention = *convention;
        let job = Job::stream(waker, Progress::default(), move |worker| {
            let (ground_truth, prediction) = (ground_truth.material(), prediction.material());
            let pair = Pair { ground_truth, prediction, convention };
            let study = study::run(&pair, &worker.progress, |study| {
                // Where the window has dropped this job, its progress ends the work.
                let _ = worker.replace(study.clone());
            })?;
            Ok(study)
        });
        self.running = Some(RunningStudy { key, job });
    }

    /// Takes over what has been measured since the last call; returns the error of a failed study.
    pub fn poll(&mut self) -> Option<Error> {
        let running = self.running.as_ref()?;
        let result = running.job.poll();
        let latest = running.job.updates().pop();
        let key = running.key;
        if let Some(study) = latest {
            self.measured = Some(Measured { key, study, complete: false });
        }
        let result = result?;
        self.running = None;
        match result {
            Ok(study) => {
                self.measured = Some(Measured { key, study, complete: true });
                None
            }
            Err(error) => Some(error),
        }
    }

    /// Stops measuring; what has been measured stays.
    pub fn cancel(&mut self) {
        self.running = None;
    }
}

fn key(materials: &MaterialList, prediction: usize, convention: &Convention) -> Option<StudyKey> {
    let ids = [materials.ground_truth()?.id(), materials.predictions().get(prediction)?.id()];
    Some((ids, *convention))
}
