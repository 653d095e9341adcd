//! Scenes of the loss of the chosen prediction, worst first.

use std::sync::Arc;

use svbrdf_core::loss::Request;
use svbrdf_evaluate::why::{RankedScene, worst_first};

use crate::error::Error;
use crate::jobs::why::pair::{ComparedPair, PairKey};
use crate::jobs::why::thumbnails::{self, Thumbnails};
use crate::jobs::work::job::Job;
use crate::jobs::work::latest::Latest;
use crate::jobs::work::waker::Waker;

/// What a list of scenes depends on.
#[derive(Clone, Debug, PartialEq)]
struct ScenesKey {
    pair: PairKey,
    scenes: Request,
}

/// The scenes of the chosen prediction, and their thumbnails.
#[derive(Debug, Default)]
pub struct ScenesJob {
    list: Latest<ScenesKey, Arc<Vec<RankedScene>>>,
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
                Ok(Arc::new(worst_first(&outcome)))
            })
        });
        self.thumbnails.drop_other(&wanted);
        if let Some((of, list)) = self.list.get()
            && *of == wanted
        {
            let of_thumbnails = self.thumbnails.follow(Some(wanted), |_| {
                let (pair, list) = (pair.clone(), list.clone());
                Job::start(waker, move |progress| thumbnails::make(&pair, &list, progress))
            });
            error = error.or(of_thumbnails);
        }
        error
    }

    /// The scenes of this pair, worst first, and their thumbnails once they are made.
    pub fn get(
        &self,
        pair: &ComparedPair,
        scenes: &Request,
    ) -> Option<(&[RankedScene], Option<&Thumbnails>)> {
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
