//! Answers: what the window draws is asked for where it is drawn, in every frame.
//!
//! A question that has no answer yet waits. One is answered at a time, on all processors: the first in the order of asking, which is that
//! on the screen. What a frame does not ask for is cancelled; its answer stays for a while.

pub mod content;
pub mod question;
#[cfg(test)]
mod tests;

use std::any::{Any, TypeId};
use std::cell::RefCell;
use std::fmt;
use std::sync::Arc;
use std::time::Duration;

use super::work::Waker;
use crate::error::Error;
pub use question::{Answer, Answered, Pace, Question, Work};
use question::{AnyEntry, Entry, Phase};

/// The questions of the window with their answers.
#[derive(Default)]
pub struct Answers {
    waker: Waker,
    asked: RefCell<Asked>,
}

#[derive(Default)]
struct Asked {
    entries: Vec<Box<dyn AnyEntry>>,
    frame: u64,
    /// The questions of this frame so far.
    count: usize,
}

impl fmt::Debug for Answers {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Answers")
    }
}

impl Answers {
    pub fn new(waker: Waker) -> Self {
        Self { waker, asked: RefCell::default() }
    }

    /// Begins a frame, in which no answer changes: what depends on an answer is asked for in the frame that has it, and stands where it
    /// stands before anything behind it is started. Returns what has failed since the last frame.
    pub fn begin_frame(&mut self) -> Vec<Error> {
        let entries = &mut self.asked.get_mut().entries;
        entries.iter_mut().for_each(|entry| entry.poll());
        entries.iter_mut().filter_map(|entry| entry.take_error()).collect()
    }

    /// The answer to `question`, which is asked for by this.
    pub fn get<Q: Question>(&self, question: &Q) -> Answer<Q::Answer> {
        self.ask(question, false)
    }

    /// The same of a question that is answered after all those of the frame that are not asked so.
    pub fn get_later<Q: Question>(&self, question: &Q) -> Answer<Q::Answer> {
        self.ask(question, true)
    }

    /// The answer, where there is one; it is not asked for.
    pub fn known<Q: Question>(&self, question: &Q) -> Option<Arc<Answered<Q::Answer>>> {
        let mut asked = self.asked.borrow_mut();
        asked.entry(question)?.state().ready()
    }

    /// The answer to `question`, or the latest one that may be drawn until it is there; and whether it is its own.
    pub fn drawn<Q: Question>(&self, question: &Q) -> Option<(Arc<Answered<Q::Answer>>, bool)> {
        match self.get(question) {
            Answer::Ready(answered) | Answer::Partial(answered, ..) => Some((answered, true)),
            _ => Some((self.latest(question)?, false)),
        }
    }

    /// The latest answer to a question that this one is like. It stays while it is drawn.
    pub fn latest<Q: Question>(&self, question: &Q) -> Option<Arc<Answered<Q::Answer>>> {
        let mut asked = self.asked.borrow_mut();
        let frame = asked.frame;
        let all = asked.of_kind::<Q>().filter(|entry| question.is_like(&entry.question));
        let ready = all.filter(|entry| matches!(entry.phase(), Phase::Ready(_)));
        let latest = ready.max_by_key(|entry| entry.turn)?;
        latest.drawn = frame;
        latest.state().ready()
    }

    /// Whether a question of this kind is being answered.
    pub fn is_running<Q: Question>(&self) -> bool {
        self.asked.borrow_mut().of_kind::<Q>().any(|entry| entry.phase() == Phase::Running)
    }

    /// Stops the work on questions of this kind, by hand.
    pub fn stop<Q: Question>(&self) {
        self.asked.borrow_mut().of_kind::<Q>().for_each(Entry::end);
    }

    /// Begins again with what was stopped.
    pub fn resume<Q: Question>(&self) {
        self.asked.borrow_mut().of_kind::<Q>().for_each(Entry::resume);
    }

    fn ask<Q: Question>(&self, question: &Q, later: bool) -> Answer<Q::Answer> {
        let mut asked = self.asked.borrow_mut();
        asked.count += 1;
        let turn = (asked.frame, later, asked.count);
        if let Some(entry) = asked.entry(question) {
            // Twice in a frame: the first counts.
            if entry.turn.0 != turn.0 || (entry.turn.1 && !later) {
                entry.turn = turn;
            }
            return entry.state();
        }
        asked.entries.push(Box::new(Entry::new(question.clone(), turn)));
        Answer::Running(0.0, Duration::ZERO)
    }

    /// Ends a frame: starts what it has asked for, and cancels and drops what it has not.
    pub fn end_frame(&mut self) {
        let Asked { entries, frame, count } = self.asked.get_mut();
        entries.sort_by_key(|entry| (u64::MAX - entry.turn().0, entry.turn()));
        let is_asked = |entry: &dyn AnyEntry| entry.is_of(*frame);
        let in_sight: Vec<TypeId> =
            entries.iter().filter(|entry| is_asked(&***entry)).map(|entry| entry.kind()).collect();
        let mut kept: Vec<(TypeId, usize)> = Vec::new();
        entries.retain(|entry| {
            match entry.phase() {
                _ if is_asked(&**entry) => true,
                Phase::Running => entry.pace() == Pace::AtOnce,
                // What it holds may be large.
                Phase::Ready(_) if entry.pace() == Pace::AtOnce && !in_sight.contains(&entry.kind()) => false,
                Phase::Ready(most) => {
                    let kind = entry.kind();
                    let at = kept.iter().position(|(of, _)| *of == kind).unwrap_or_else(|| {
                        kept.push((kind, 0));
                        kept.len() - 1
                    });
                    kept[at].1 += 1;
                    kept[at].1 <= most
                }
                Phase::Waiting | Phase::Failed => false,
            }
        });
        start_next(entries, &self.waker);
        (*frame, *count) = (*frame + 1, 0);
    }
}

/// Starts those that do not wait, of moving ones one of a kind at a time, and the first of the others; what is before it in turn stops a
/// running one.
fn start_next(entries: &mut [Box<dyn AnyEntry>], waker: &Waker) {
    let is_in_turn = |entry: &dyn AnyEntry| entry.pace() == Pace::InTurn;
    let running = entries.iter().filter(|entry| !is_in_turn(&***entry) && entry.phase() == Phase::Running);
    let mut busy: Vec<TypeId> = running.map(|entry| entry.kind()).collect();
    for entry in entries.iter_mut().filter(|one| !is_in_turn(&***one) && one.phase() == Phase::Waiting) {
        if entry.pace() == Pace::Beside || !busy.contains(&entry.kind()) {
            busy.push(entry.kind());
            entry.start(waker);
        }
    }
    let mut others = entries
        .iter_mut()
        .filter(|entry| is_in_turn(&***entry) && matches!(entry.phase(), Phase::Waiting | Phase::Running));
    if let Some(first) = others.next() {
        others.for_each(|entry| entry.stop());
        first.start(waker);
    }
}

impl Asked {
    fn of_kind<Q: Question>(&mut self) -> impl Iterator<Item = &mut Entry<Q>> {
        self.entries.iter_mut().filter_map(|entry| (&mut **entry as &mut dyn Any).downcast_mut::<Entry<Q>>())
    }

    fn entry<Q: Question>(&mut self, question: &Q) -> Option<&mut Entry<Q>> {
        self.of_kind::<Q>().find(|entry| entry.question == *question)
    }
}
