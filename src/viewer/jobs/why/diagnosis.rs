//! Diagnoses of the losses of the predictions, and the floor of the ground truth.

use std::time::{Duration, Instant};

use svbrdf_core::loss::Estimate;
use svbrdf_core::progress::Progress;
use svbrdf_evaluate::diagnose::{Diagnosis, diagnose, floor};

use crate::error::Error;
use crate::jobs::why::one_by_one::OneByOne;
use crate::jobs::why::pair::{ComparedPair, GroundTruthKey};
use crate::jobs::work::job::Job;
use crate::jobs::work::latest::Latest;
use crate::jobs::work::waker::Waker;

/// A diagnosis, and the time that it took.
#[derive(Clone, Debug)]
pub struct Diagnosed {
    pub diagnosis: Diagnosis,
    pub elapsed: Duration,
}

/// The diagnoses of the predictions, after the floor.
#[derive(Debug, Default)]
pub struct DiagnosisJob {
    floor: Latest<(GroundTruthKey, u64), Estimate>,
    diagnoses: OneByOne<Diagnosed>,
}

impl DiagnosisJob {
    /// Takes over a result, and computes the next one that is missing, as [`OneByOne::follow`] does.
    pub fn follow(
        &mut self,
        waker: &Waker,
        displayed: bool,
        (pairs, chosen): (&[ComparedPair], usize),
        seed: u64,
    ) -> Option<Error> {
        let Some(first) = pairs.first().filter(|_| displayed) else {
            self.floor.pause();
            return self.diagnoses.follow(waker, false, (pairs, chosen), seed, diagnosed(0.0));
        };
        let error = self.floor.follow_only((first.ground_truth_key(), seed), |_| {
            let pair = first.clone();
            Job::start(waker, move |progress| {
                let (material, storage) = (pair.ground_truth(), pair.ground_truth_storage());
                Ok(floor(material, storage, &pair.convention, seed, progress)?)
            })
        });
        let floor = self.floor(first, seed).map_or(0.0, |floor| floor.mean);
        let is_next = self.floor.running().is_none();
        error.or(self.diagnoses.follow(waker, is_next, (pairs, chosen), seed, diagnosed(floor)))
    }

    /// Whether this pair has neither a diagnosis nor a failure yet.
    pub fn awaits(&self, pair: &ComparedPair, seed: u64) -> bool {
        self.diagnoses.awaits(pair, &seed)
    }

    /// The diagnosis of this pair.
    pub fn get(&self, pair: &ComparedPair, seed: u64) -> Option<&Diagnosed> {
        self.diagnoses.get(pair, &seed)
    }

    /// The loss that the ground truth of this pair cannot resolve.
    pub fn floor(&self, pair: &ComparedPair, seed: u64) -> Option<&Estimate> {
        let wanted = (pair.ground_truth_key(), seed);
        self.floor.get().filter(|(key, _)| **key == wanted).map(|(_, floor)| floor)
    }

    /// The share of the work on the floor or a pair that is done and its time, while it goes on.
    pub fn busy(&self) -> Option<(f32, Duration)> {
        let floor = self.floor.running().map(|job| (job.fraction(), job.elapsed()));
        floor.or_else(|| self.diagnoses.busy())
    }
}

/// The diagnosis of a pair, whose ground truth does not resolve losses below `floor`.
fn diagnosed(
    floor: f64,
) -> impl Fn(&ComparedPair, u64, &Progress) -> Result<Diagnosed, Error> + Send + 'static {
    move |pair, seed, progress| {
        let start = Instant::now();
        let materials = [pair.ground_truth(), pair.prediction()];
        let storages = [pair.ground_truth_storage(), pair.prediction_storage()];
        let diagnosis = diagnose(materials, storages, &pair.convention, floor, seed, progress)?;
        Ok(Diagnosed { diagnosis, elapsed: start.elapsed() })
    }
}
