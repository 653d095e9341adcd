//! A question of the window, and its answer.

use std::ops::Deref;
use std::sync::Arc;
use std::time::{Duration, Instant};

use svbrdf_core::progress::Progress;

use crate::error::Error;
use crate::jobs::work::job::Worker;

/// A question with all that its answer depends on.
pub trait Question: Clone + PartialEq + Send + 'static {
    type Answer: Send + Sync + 'static;

    const PACE: Pace = Pace::InTurn;

    /// The answers of its kind that stay although no frame asks for them.
    const KEPT: usize = 64;

    /// Whether a failure is told in a message; otherwise where the answer is drawn.
    const HAS_MESSAGE: bool = true;

    /// Whether the answer to an earlier question may be drawn, as stale, until there is one to this.
    fn is_like(&self, _earlier: &Self) -> bool {
        false
    }

    /// The answer, computed on a thread of its own.
    ///
    /// # Errors
    /// Where there is none; it is told once, and not tried again while it is asked for.
    fn answer(&self, work: &Work<'_, Self::Answer>) -> Result<Self::Answer, Error>;
}

/// When a question is answered.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Pace {
    /// One after the other, in the order of asking, each on all processors.
    InTurn,
    /// In a moment: it does not wait for others, and an earlier one of its kind is answered to the end. There are answers while something
    /// moves.
    AtOnce,
    /// Beside all others, as long as it is asked for.
    Beside,
}

/// The work on an answer.
#[derive(Debug)]
pub struct Work<'a, A> {
    worker: &'a Worker<Arc<Answered<A>>>,
    start: Instant,
}

impl<'a, A> Work<'a, A> {
    /// Work that begins now.
    pub fn new(worker: &'a Worker<Arc<Answered<A>>>) -> Self {
        Self { worker, start: Instant::now() }
    }

    /// The answer, with the time that it took.
    pub fn answered(&self, answer: A) -> Arc<Answered<A>> {
        Arc::new(Answered { answer, elapsed: self.start.elapsed() })
    }

    pub fn progress(&self) -> &Progress {
        &self.worker.progress
    }

    /// Tells of an answer so far, in the place of the one before it.
    pub fn tell(&self, answer: A) {
        // Where the window has dropped this job, its progress ends the work.
        let _ = self.worker.replace(self.answered(answer));
    }
}

/// What is known of an answer.
#[derive(Debug)]
pub enum Answer<A> {
    Ready(Arc<Answered<A>>),
    /// An answer so far, the share of the work that is done, and its time.
    Partial(Arc<Answered<A>>, f32, Duration),
    /// The share of the work that is done, and its time: 0 of what waits.
    Running(f32, Duration),
    /// It was stopped by hand, with the answer so far.
    Stopped(Option<Arc<Answered<A>>>),
    Failed(Arc<str>),
}

/// An answer, and the time that it took.
#[derive(Debug)]
pub struct Answered<A> {
    pub answer: A,
    pub elapsed: Duration,
}

impl<A> Deref for Answered<A> {
    type Target = A;

    fn deref(&self) -> &A {
        &self.answer
    }
}

impl<A> Answer<A> {
    pub fn ready(self) -> Option<Arc<Answered<A>>> {
        match self {
            Self::Ready(answered) => Some(answered),
            Self::Partial(..) | Self::Running(..) | Self::Stopped(_) | Self::Failed(_) => None,
        }
    }

    /// The share and the time of the work that goes on.
    pub fn busy(&self) -> Option<(f32, Duration)> {
        match *self {
            Self::Partial(_, fraction, elapsed) | Self::Running(fraction, elapsed) => {
                Some((fraction, elapsed))
            }
            Self::Ready(_) | Self::Stopped(_) | Self::Failed(_) => None,
        }
    }
}
