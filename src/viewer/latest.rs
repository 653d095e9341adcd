//! The latest result of slow work that follows what is on the screen.

use eframe::egui;

use super::worker::Task;
use crate::error::Error;

/// The result for a key, and the work on a newer one. Work for an earlier key is completed, so that there are results while
/// something moves.
#[derive(Debug)]
pub(super) struct Latest<K, R> {
    running: Option<(K, Task<R>)>,
    latest: Option<(K, R)>,
    /// What could not be computed, which is not tried again.
    failed: Option<K>,
}

impl<K, R> Default for Latest<K, R> {
    fn default() -> Self {
        Self { running: None, latest: None, failed: None }
    }
}

impl<K: Clone + PartialEq, R: Send + 'static> Latest<K, R> {
    /// The latest result and what it is of.
    pub(super) fn get(&self) -> Option<(&K, &R)> {
        self.latest.as_ref().map(|(key, result)| (key, result))
    }

    /// The work that is going on.
    pub(super) fn running(&self) -> Option<&Task<R>> {
        self.running.as_ref().map(|(_, task)| task)
    }

    /// Cancels the work, and keeps the latest result.
    pub(super) fn rest(&mut self) {
        self.running = None;
    }

    /// Cancels the work for another key than `wanted`: slow work for what has changed is not worth its end.
    pub(super) fn drop_other(&mut self, wanted: &K) {
        if self.running.as_ref().is_some_and(|(key, _)| key != wanted) {
            self.running = None;
        }
    }

    /// Takes over a result, and starts the work on `wanted` if it is another one; without `wanted`, all is dropped.
    pub(super) fn follow(
        &mut self,
        ctx: &egui::Context,
        wanted: Option<K>,
        start: impl FnOnce(&K) -> Task<R>,
    ) -> Option<Error> {
        let Some(wanted) = wanted else {
            *self = Self::default();
            return None;
        };
        let mut error = None;
        if let Some((key, task)) = &self.running
            && let Some(result) = task.poll(ctx)
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
            let task = start(&wanted);
            self.running = Some((wanted, task));
        }
        error
    }
}
