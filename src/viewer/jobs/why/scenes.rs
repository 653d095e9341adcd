//! Scenes of the loss of the chosen prediction, worst first.

use std::sync::Arc;

use svbrdf_core::loss::Request;
use svbrdf_core::model::scene::Kind;
use svbrdf_core::picture::statistics::Histogram;
use svbrdf_evaluate::why::{Distribution, RankedScene, worst_first};

use crate::error::Error;
use crate::jobs::why::pair::{ComparedPair, PairKey};
use crate::jobs::why::thumbnails::{self, Thumbnails};
use crate::jobs::work::job::Job;
use crate::jobs::work::latest::Latest;
use crate::jobs::work::waker::Waker;

/// Bins of the histogram of the losses of scenes.
const BINS: usize = 40;

/// What a list of scenes depends on.
#[derive(Clone, Debug, PartialEq)]
struct ScenesKey {
    pair: PairKey,
    scenes: Request,
}

/// The scenes of a loss.
#[derive(Clone, Debug)]
pub struct SceneList {
    /// The numbers of near-field and of distant ones.
    pub counts: [usize; 2],
    /// Worst first.
    pub ranked: Vec<RankedScene>,
    /// The mean of their losses.
    pub mean: f64,
    /// `None` without scenes.
    pub distribution: Option<Distribution>,
    pub histogram: Histogram,
}

/// The scenes of the chosen prediction, and their thumbnails.
#[derive(Debug, Default)]
pub struct ScenesJob {
    list: Latest<ScenesKey, Arc<SceneList>>,
    thumbnails: Latest<ScenesKey, Thumbnails>,
}

impl ScenesJob {
    /// Takes over results, and computes what is wanted now; where they are not `displayed`, the latest results stay.
    pub fn follow(
        &mut self,
        waker: &Waker,
        displayed: bool,
        pair: Option<&ComparedPair>,
        scenes: Request,
    ) -> Option<Error> {
        let Some(pair) = pair.filter(|_| displayed) else {
            self.list.pause();
            self.thumbnails.pause();
            return None;
        };
        let wanted = ScenesKey { pair: pair.key, scenes };
        let mut error = self.list.follow_only(wanted.clone(), |key| {
            let (pair, scenes) = (pair.clone(), key.scenes.clone());
            Job::start(waker, move |progress| {
                let outcome = pair.comparison()?.run(&scenes, progress)?;
                Ok(Arc::new(SceneList::new(worst_first(&outcome))))
            })
        });
        self.thumbnails.drop_other(&wanted);
        if let Some((of, list)) = self.list.get()
            && *of == wanted
        {
            let of_thumbnails = self.thumbnails.follow(Some(wanted), |_| {
                let (pair, list) = (pair.clone(), list.clone());
                Job::start(waker, move |progress| thumbnails::make(&pair, &list.ranked, progress))
            });
            error = error.or(of_thumbnails);
        }
        error
    }

    /// The scenes of this pair, and their thumbnails once they are made.
    pub fn get(&self, pair: &ComparedPair, scenes: &Request) -> Option<(&SceneList, Option<&Thumbnails>)> {
        let is_wanted = |of: &ScenesKey| of.pair == pair.key && of.scenes == *scenes;
        let (_, list) = self.list.get().filter(|(of, _)| is_wanted(of))?;
        let thumbnails = self.thumbnails.get().filter(|(of, _)| is_wanted(of));
        Some((list, thumbnails.map(|(_, thumbnails)| thumbnails)))
    }

    /// The share of the work that is done, while it goes on.
    pub fn busy(&self) -> Option<f32> {
        self.list.running().map(Job::fraction)
    }
}

impl SceneList {
    fn new(ranked: Vec<RankedScene>) -> Self {
        let count = |kind| ranked.iter().filter(|scene| scene.scene.kind == kind).count();
        let counts = [Kind::Near, Kind::Distant].map(count);
        let losses: Vec<f64> = ranked.iter().map(|scene| scene.losses[0]).collect();
        let largest = losses.first().copied().filter(|largest| *largest > 0.0).unwrap_or(1.0);
        let values: Vec<f32> = losses.iter().map(|loss| *loss as f32).collect();
        // The largest loss rounds up or down to its f32: the axis ends at that.
        let axis = [0.0, f64::from(largest as f32)];
        let histogram = Histogram::of(&values, axis, BINS);
        let mean = losses.iter().sum::<f64>() / losses.len().max(1) as f64;
        Self { counts, ranked, mean, distribution: Distribution::of(&losses), histogram }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::view::state::ViewState;

    #[test]
    fn every_scene_is_in_a_bin_and_the_worst_in_the_last() {
        let scene = ViewState::default().scene;
        let one = |(index, loss): (usize, &f64)| RankedScene { index, scene, losses: vec![*loss] };
        for losses in [vec![0.9, 0.3, 0.1, 0.0], vec![0.0, 0.0], vec![1e-30]] {
            let list = SceneList::new(losses.iter().enumerate().map(one).collect());
            assert_eq!(list.counts, [losses.len(), 0]);
            let Histogram { counts, below, above, .. } = &list.histogram;
            assert_eq!(counts.iter().sum::<u64>(), losses.len() as u64, "{losses:?}");
            assert_eq!((*below, *above), (0, 0));
            assert!(losses[0] == 0.0 || counts.last() == Some(&1), "{losses:?}");
            assert!((list.mean - losses.iter().sum::<f64>() / losses.len() as f64).abs() < 1e-15);
        }
    }
}
