//! Progress of long work, seen from another thread, and the wish to stop it.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};

use crate::error::Error;

/// Shared between the thread that works and the one that watches.
#[derive(Debug, Default)]
pub struct Progress {
    done: AtomicU64,
    total: AtomicU64,
    cancelled: Arc<AtomicBool>,
}

impl Progress {
    /// The work announces how many steps it has in all; the count starts again at 0.
    pub fn begin(&self, total: u64) {
        self.done.store(0, Ordering::Relaxed);
        self.total.store(total, Ordering::Relaxed);
    }

    /// The work has done one more step.
    ///
    /// # Errors
    /// [`Error::Cancelled`] once [`Progress::cancel`] was called: the work passes it on.
    pub fn step(&self) -> Result<(), Error> {
        self.advance(1)
    }

    /// The work has done `steps` more steps.
    ///
    /// # Errors
    /// As [`Progress::step`].
    pub fn advance(&self, steps: u64) -> Result<(), Error> {
        self.done.fetch_add(steps, Ordering::Relaxed);
        if self.is_cancelled() {
            return Err(Error::Cancelled);
        }
        Ok(())
    }

    /// The progress of a part of the work, which counts by itself: cancelling either cancels both.
    #[must_use]
    pub fn part(&self) -> Self {
        Self { cancelled: self.cancelled.clone(), ..Self::default() }
    }

    /// Asks the work to stop at its next step.
    pub fn cancel(&self) {
        self.cancelled.store(true, Ordering::Relaxed);
    }

    /// Whether the work was asked to stop.
    pub fn is_cancelled(&self) -> bool {
        self.cancelled.load(Ordering::Relaxed)
    }

    /// (steps done, steps in all); (0, 0) before the work has begun.
    pub fn counts(&self) -> (u64, u64) {
        (self.done.load(Ordering::Relaxed), self.total.load(Ordering::Relaxed))
    }
}
