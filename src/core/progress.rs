//! The progress of long work, and its cancellation, from another thread.
//!
//! ```
//! use svbrdf_core::error::Error;
//! use svbrdf_core::progress::Progress;
//!
//! let progress = Progress::default();
//! progress.begin(100);
//! progress.step()?;
//! assert_eq!(progress.counts(), (1, 100));
//! progress.cancel();
//! assert!(matches!(progress.step(), Err(Error::Cancelled)));
//! # Ok::<(), Error>(())
//! ```

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};

use crate::error::Error;

/// The number of steps done and to do, shared by the working thread and the thread that watches it.
#[derive(Debug, Default)]
pub struct Progress {
    done: AtomicU64,
    total: AtomicU64,
    cancelled: Arc<AtomicBool>,
}

impl Progress {
    /// Announces `total` steps and sets the count to 0.
    pub fn begin(&self, total: u64) {
        self.done.store(0, Ordering::Relaxed);
        self.total.store(total, Ordering::Relaxed);
    }

    /// Counts one step.
    ///
    /// # Errors
    /// [`Error::Cancelled`] once [`Progress::cancel`] was called.
    pub fn step(&self) -> Result<(), Error> {
        self.advance(1)
    }

    /// Counts `steps` steps.
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

    /// The progress of a part of the work, with a count of its own. Cancelling either cancels both.
    #[must_use]
    pub fn part(&self) -> Self {
        Self { cancelled: self.cancelled.clone(), ..Self::default() }
    }

    /// Cancels the work: its next step fails.
    pub fn cancel(&self) {
        self.cancelled.store(true, Ordering::Relaxed);
    }

    /// Whether the work was cancelled.
    pub fn is_cancelled(&self) -> bool {
        self.cancelled.load(Ordering::Relaxed)
    }

    /// (steps done, total steps); (0, 0) before the work has begun.
    pub fn counts(&self) -> (u64, u64) {
        (self.done.load(Ordering::Relaxed), self.total.load(Ordering::Relaxed))
    }
}
