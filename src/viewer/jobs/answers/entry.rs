//! One question of the window, and how far its answer is.

use std::any::{Any, TypeId};
use std::sync::Arc;
use std::time::Duration;

use super::question::{Answer, Answered, Pace, Question, Work};
use crate::error::Error;
use crate::jobs::work::job::Job;
use crate::jobs::work::waker::Waker;

/// When a question was asked last: the frame, whether after all others of it, and its place among them.
pub type Turn = (u64, bool, usize);

/// A question, when it was asked last, and what is known of its answer.
pub struct Entry<Q: Question> {
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
pub enum Phase {
    Waiting,
    Running,
    Ready(usize),
    /// It failed, or was stopped by hand.
    Failed,
}

/// An entry of any kind.
pub trait AnyEntry: Any {
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
