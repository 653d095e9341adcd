//! A question of the window, its answer, and how far that is.

use std::any::{Any, TypeId};
use std::ops::Deref;
use std::sync::Arc;
use std::time::{Duration, Instant};

use svbrdf_core::progress::Progress;

use crate::error::Error;
use crate::jobs::work::{Job, Waker, Worker};

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

/// When a question was asked last: the frame, whether after all others of it, and its place among them.
pub(super) type Turn = (u64, bool, usize);

/// A question, when it was asked last, and what is known of its answer.
pub(super) struct Entry<Q: Question> {
    pub question: Q,
    pub turn: Turn,
    /// The frame in which its answer was drawn last in the place of another.
    pub drawn: u64,
    state: State<Q::Answer>,
}

/// The work on an answer.
type Running<A> = Job<Arc<Answered<A>>, Arc<Answered<A>>>;

enum State<A> {
    Waiting,
    /// With the latest answer so far.
    Running(Running<A>, Option<Arc<Answered<A>>>),
    Ready(Arc<Answered<A>>),
    /// By hand, with the answer so far.
    Stopped(Option<Arc<Answered<A>>>),
    /// The reason, and the error until it is told.
    Failed(Arc<str>, Option<Error>),
}

/// How far an answer is; of one that is ready, how many of its kind stay.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Phase {
    Waiting,
    Running,
    Ready(usize),
    /// It failed, or was stopped by hand.
    Failed,
}

/// An entry of any kind.
pub(super) trait AnyEntry: Any {
    fn kind(&self) -> TypeId;
    fn pace(&self) -> Pace;
    fn turn(&self) -> Turn;
    /// Whether it was asked, or its answer drawn, in this frame.
    fn is_of(&self, frame: u64) -> bool;
    fn phase(&self) -> Phase;
    fn start(&mut self, waker: &Waker);
    fn stop(&mut self);
    fn poll(&mut self);
    fn take_error(&mut self) -> Option<Error>;
}

impl<Q: Question> Entry<Q> {
    /// A question that waits.
    pub fn new(question: Q, turn: Turn) -> Self {
        Self { question, turn, drawn: turn.0, state: State::Waiting }
    }

    pub fn state(&self) -> Answer<Q::Answer> {
        match &self.state {
            State::Waiting => Answer::Running(0.0, Duration::ZERO),
            State::Running(job, None) => Answer::Running(job.fraction(), job.elapsed()),
            State::Running(job, Some(so_far)) => {
                Answer::Partial(so_far.clone(), job.fraction(), job.elapsed())
            }
            State::Ready(answered) => Answer::Ready(answered.clone()),
            State::Stopped(so_far) => Answer::Stopped(so_far.clone()),
            State::Failed(reason, _) => Answer::Failed(reason.clone()),
        }
    }

    pub fn resume(&mut self) {
        if matches!(self.state, State::Stopped(_)) {
            self.state = State::Waiting;
        }
    }

    /// Ends the work.
    pub fn end(&mut self) {
        if let State::Running(_, so_far) = &self.state {
            self.state = State::Stopped(so_far.clone());
        }
    }
}

impl<Q: Question> AnyEntry for Entry<Q> {
    fn kind(&self) -> TypeId {
        TypeId::of::<Q>()
    }

    fn pace(&self) -> Pace {
        Q::PACE
    }

    fn turn(&self) -> Turn {
        self.turn
    }

    fn is_of(&self, frame: u64) -> bool {
        self.turn.0.max(self.drawn) == frame
    }

    fn phase(&self) -> Phase {
        match self.state {
            State::Waiting => Phase::Waiting,
            State::Running(..) => Phase::Running,
            State::Ready(_) => Phase::Ready(Q::KEPT),
            State::Failed(..) | State::Stopped(_) => Phase::Failed,
        }
    }

    fn start(&mut self, waker: &Waker) {
        if matches!(self.state, State::Waiting) {
            let question = self.question.clone();
            let job = Job::stream(waker, move |worker| {
                let work = Work::new(worker);
                Ok(work.answered(question.answer(&work)?))
            });
            self.state = State::Running(job, None);
        }
    }

    fn stop(&mut self) {
        if matches!(self.state, State::Running(..)) {
            self.state = State::Waiting;
        }
    }

    fn poll(&mut self) {
        let State::Running(job, so_far) = &mut self.state else { return };
        let ended = job.poll();
        *so_far = job.updates().pop().or(so_far.take());
        self.state = match ended {
            None => return,
            Some(Ok(answered)) => State::Ready(answered),
            Some(Err(error)) => State::Failed(error.to_string().into(), Some(error)),
        };
    }

    fn take_error(&mut self) -> Option<Error> {
        let State::Failed(_, error) = &mut self.state else { return None };
        error.take().filter(|error| Q::HAS_MESSAGE && !error.is_cancelled())
    }
}
