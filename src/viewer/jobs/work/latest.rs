//! Latest result for a key: slow work that follows what is displayed.

use super::job::Job;
use crate::error::Error;

/// The result for a key, and the job for a newer one. A job for an earlier key is completed, so that there are results while
/// something moves.
#[derive(Debug)]
pub struct Latest<K, R, U = ()> {
    running: Option<(K, Job<R, U>)>,
    latest: Option<(K, R)>,
    /// What could not be computed, which is not tried again.
    failed: Option<K>,
}

impl<K, R, U> Default for Latest<K, R, U> {
    fn default() -> Self {
        Self { running: None, latest: None, failed: None }
    }
}

impl<K: Clone + PartialEq, R: Send + 'static, U: Send + 'static> Latest<K, R, U> {
    /// The latest result and its key.
    pub fn get(&self) -> Option<(&K, &R)> {
        self.latest.as_ref().map(|(key, result)| (key, result))
    }

    /// The job that is running.
    pub fn running(&self) -> Option<&Job<R, U>> {
        self.running.as_ref().map(|(_, job)| job)
    }

    /// The updates of the running job since the last call, and its key.
    pub fn updates(&self) -> Option<(&K, Vec<U>)> {
        self.running.as_ref().map(|(key, job)| (key, job.updates()))
    }

    /// Cancels the job; the latest result stays.
    pub fn pause(&mut self) {
        self.running = None;
    }

    /// As [`Self::follow`], but cancels the job of an earlier key: slow work for what has changed is not worth its end.
    pub fn follow_only(&mut self, wanted: K, start: impl FnOnce(&K) -> Job<R, U>) -> Option<Error> {
        self.drop_other(&wanted);
        self.follow(Some(wanted), start)
    }

    /// Cancels the job of another key than `wanted`.
    pub fn drop_other(&mut self, wanted: &K) {
        if self.running.as_ref().is_some_and(|(key, _)| key != wanted) {
            self.running = None;
        }
    }

    /// Takes over a result, and starts the job for `wanted` if it is another one; without `wanted`, all is dropped.
    pub fn follow(&mut self, wanted: Option<K>, start: impl FnOnce(&K) -> Job<R, U>) -> Option<Error> {
        let Some(wanted) = wanted else {
            *self = Self::default();
            return None;
        };
        let mut error = None;
        if let Some((key, job)) = &self.running
            && let Some(result) = job.poll()
        {
            match result {
                Ok(result) => self.latest = Some((key.clone(), result)),
                Err(problem) => {
                    self.failed = Some(key.clone());
                    error = Some(problem);
                }
            }
            self.running = None;
        }
        let done = self.latest.as_ref().is_some_and(|(key, _)| *key == wanted);
        if self.running.is_none() && self.failed.as_ref() != Some(&wanted) && !done {
            let job = start(&wanted);
            self.running = Some((wanted, job));
        }
        error
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::jobs::work::waker::Waker;

    /// Follows `wanted` until its result is there; the keys for which jobs were started.
    fn settle(latest: &mut Latest<u32, u32>, wanted: u32) -> Vec<u32> {
        let mut started = Vec::new();
        while latest.get().is_none_or(|(key, _)| *key != wanted) {
            latest.follow(Some(wanted), |key| {
                started.push(*key);
                let key = *key;
                Job::start(&Waker::default(), move |_| Ok(10 * key))
            });
            std::thread::yield_now();
        }
        started
    }

    #[test]
    fn a_result_is_of_its_key_and_computed_once() {
        let mut latest = Latest::default();
        assert_eq!(settle(&mut latest, 1), [1]);
        assert_eq!(latest.get(), Some((&1, &10)));
        assert!(settle(&mut latest, 1).is_empty(), "it is there");
        assert_eq!(settle(&mut latest, 2), [2]);
        assert_eq!(latest.get(), Some((&2, &20)));
        latest.follow(None, |_| unreachable!());
        assert_eq!(latest.get(), None);
    }

    #[test]
    fn what_has_failed_is_reported_once_and_not_tried_again() {
        let mut latest = Latest::<u32, ()>::default();
        let (mut errors, mut starts) = (0, 0);
        for _ in 0..50 {
            let error = latest.follow(Some(1), |_| {
                starts += 1;
                Job::start(&Waker::default(), |_| Err(Error::internal("planted")))
            });
            errors += usize::from(error.is_some());
            std::thread::sleep(std::time::Duration::from_millis(2));
        }
        assert_eq!((errors, starts), (1, 1));
    }
}
