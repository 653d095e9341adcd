//! Results of all predictions, computed one by one, the chosen prediction first.

use std::time::Duration;

use svbrdf_core::progress::Progress;

use crate::error::Error;
use crate::jobs::why::pair::{ComparedPair, PairKey};
use crate::jobs::work::job::Job;
use crate::jobs::work::latest::Latest;
use crate::jobs::work::waker::Waker;

/// What a result depends on: a pair, and a seed or scenes.
#[derive(Clone, Debug, PartialEq)]
struct ResultKey<K> {
    pair: PairKey,
    scenes: K,
}

/// A result per prediction.
#[derive(Debug)]
pub struct OneByOne<R, K = u64> {
    latest: Latest<ResultKey<K>, R>,
    /// The results of open predictions; `None` of what could not be computed, which is not tried again.
    done: Vec<(ResultKey<K>, Option<R>)>,
}

impl<R, K> Default for OneByOne<R, K> {
    fn default() -> Self {
        Self { latest: Latest::default(), done: Vec::new() }
    }
}

impl<R: Clone + Send + 'static, K: Clone + PartialEq + Send + 'static> OneByOne<R, K> {
    /// Takes over a result, and computes the next one that is awaited: of the `chosen` pair first. Where they are not
    /// `displayed`, the results stay.
    pub fn follow(
        &mut self,
        waker: &Waker,
        displayed: bool,
        (pairs, chosen): (&[ComparedPair], usize),
        scenes: K,
        compute: impl Fn(&ComparedPair, K, &Progress) -> Result<R, Error> + Send + 'static,
    ) -> Option<Error> {
        if !displayed {
            self.latest.pause();
            return None;
        }
        self.done.retain(|(key, _)| key.scenes == scenes && pairs.iter().any(|pair| pair.key == key.pair));
        let awaited = |pair: &&ComparedPair| self.awaits(pair, &scenes);
        let pair = pairs.get(chosen).into_iter().chain(pairs).find(awaited)?;
        let wanted = ResultKey { pair: pair.key, scenes: scenes.clone() };
        let error = self.latest.follow_only(wanted.clone(), |_| {
            let pair = pair.clone();
            Job::start(waker, move |progress| compute(&pair, scenes, progress))
        });
        let result = self.latest.get().filter(|(key, _)| **key == wanted).map(|(_, result)| result.clone());
        if result.is_some() || error.is_some() {
            self.done.push((wanted, result));
            // For the next one that is awaited.
            waker.wake();
        }
        error
    }

    /// Whether this pair has neither a result nor a failure yet.
    pub fn awaits(&self, pair: &ComparedPair, scenes: &K) -> bool {
        self.found(pair, scenes).is_none()
    }

    /// The result of this pair.
    pub fn get(&self, pair: &ComparedPair, scenes: &K) -> Option<&R> {
        self.found(pair, scenes)?.as_ref()
    }

    fn found(&self, pair: &ComparedPair, scenes: &K) -> Option<&Option<R>> {
        let is_wanted = |key: &ResultKey<K>| key.pair == pair.key && key.scenes == *scenes;
        self.done.iter().find(|(key, _)| is_wanted(key)).map(|(_, result)| result)
    }

    /// The share of the work on a pair that is done and its time, while it goes on.
    pub fn busy(&self) -> Option<(f32, Duration)> {
        self.latest.running().map(|job| (job.fraction(), job.elapsed()))
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use svbrdf_files::source::MaterialSource;

    use super::*;
    use crate::model::material::loaded::LoadedMaterial;
    use crate::model::material::read::ReadMaterial;
    use crate::model::view::ViewState;

    #[test]
    fn a_pair_that_fails_is_reported_once_and_does_not_keep_the_others_waiting() {
        let read = |number| MaterialSource::built_in(number).read(&Progress::default()).unwrap();
        let one = |number| ReadMaterial::new(MaterialSource::built_in(number), read(number));
        let all = [0, 1, 2].map(|number| LoadedMaterial::new(Arc::new(one(number))));
        let pairs = ComparedPair::all(&all, &ViewState::default());
        let (mut results, mut errors) = (OneByOne::<String>::default(), 0);
        for _ in 0..500 {
            let compute = |pair: &ComparedPair, _, _: &Progress| match pair.prediction().name() {
                "blurred normals" => Err(Error::internal("planted")),
                name => Ok(name.to_owned()),
            };
            let error = results.follow(&Waker::default(), true, (&pairs, 0), 7, compute);
            errors += usize::from(error.is_some());
            if pairs.iter().all(|pair| !results.awaits(pair, &7)) {
                break;
            }
            std::thread::sleep(Duration::from_millis(2));
        }
        assert_eq!(errors, 1);
        let found = [0, 1].map(|pair| results.get(&pairs[pair], &7).map(String::as_str));
        assert_eq!(found, [None, Some("wrong roughness")]);
        assert!(results.awaits(&pairs[0], &8), "another seed");
    }
}
