//! Job on the robustness of the order of predictions, or of the methods of a data set.

use std::sync::Arc;

use svbrdf_core::model::convention::Convention;
use svbrdf_core::progress::Progress;
use svbrdf_evaluate::report::{Compared, RobustReport};
use svbrdf_evaluate::robust::RobustInput;

use super::context::JobContext;
use super::job::Job;
use super::latest::Latest;
use super::waker::Waker;
use crate::error::Error;
use crate::model::material::loaded::LoadedMaterial;
use crate::model::material::read::MaterialId;

/// The report, or why there is none.
pub type OrderAnswer = Result<Arc<RobustReport>, String>;

/// The answer for a key, and how far the next one is.
#[derive(Debug)]
pub struct OrderJob<K>(Latest<K, OrderAnswer>);

impl<K> Default for OrderJob<K> {
    fn default() -> Self {
        Self(Latest::default())
    }
}

impl<K: Clone + PartialEq> OrderJob<K> {
    /// Takes over an answer, and asks anew where `wanted` is another question; `None`: it is not in sight.
    pub fn follow<W>(&mut self, waker: &Waker, wanted: Option<K>, work: impl FnOnce(&K) -> W) -> Option<Error>
    where
        W: FnOnce(&Progress) -> Result<RobustReport, Error> + Send + 'static,
    {
        let Some(wanted) = wanted else {
            self.0.pause();
            return None;
        };
        self.0.follow_only(wanted, |key| {
            let work = work(key);
            Job::start(waker, move |progress| match work(progress) {
                Ok(report) => Ok(Ok(Arc::new(report))),
                Err(error) if error.is_cancelled() => Err(error),
                Err(error) => Ok(Err(error.to_string())),
            })
        })
    }

    /// The answer; until that to the latest question is there, the running job.
    pub fn state(&self) -> Result<Option<&OrderAnswer>, &Job<OrderAnswer>> {
        self.0.running().map_or_else(|| Ok(self.0.get().map(|(_, answer)| answer)), Err)
    }
}

/// What the order of the predictions in the window depends on.
#[derive(Clone, Debug, PartialEq)]
pub struct OrderKey {
    ids: Vec<MaterialId>,
    names: Vec<String>,
    convention: Convention,
    /// Error of the losses, in percent, and seed of their scenes.
    target_percent: f64,
    seed: u64,
}

impl OrderJob<OrderKey> {
    /// Asks about the predictions in the window, of which there are at least two.
    pub fn follow_predictions(
        &mut self,
        work: &JobContext<'_>,
        is_open: bool,
        (target_percent, seed): (f64, u64),
    ) -> Option<Error> {
        let key = OrderKey {
            ids: work.materials.iter().map(LoadedMaterial::id).collect(),
            names: work.materials.iter().map(|one| one.name().to_owned()).collect(),
            convention: work.view.convention(),
            target_percent,
            seed,
        };
        let wanted = (is_open && work.materials.len() > 2).then_some(key);
        self.follow(work.waker, wanted, |key| {
            let (key, materials) = (key.clone(), work.materials());
            move |progress: &Progress| {
                let mut all = materials.iter().map(|read| read.material());
                let ground_truth = all.next().ok_or_else(|| Error::internal("there is no ground truth"))?;
                let OrderKey { convention, target_percent, seed, .. } = key;
                let target_error = target_percent / 100.0;
                let input =
                    RobustInput { ground_truth, predictions: all.collect(), convention, target_error, seed };
                let (name, names) = (key.names[0].clone(), &key.names[1..]);
                let compared = Compared { ground_truth: name, ..Compared::new(ground_truth, &convention) };
                Ok(RobustReport::of_answers(compared, Vec::new(), names, &input.answers(progress)?))
            }
        })
    }
}
