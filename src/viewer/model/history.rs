//! History of the model: earlier moments to return to, as many as 100.

use std::collections::VecDeque;

use svbrdf_core::loss::FileScenes;
use svbrdf_files::photograph::SessionPhotograph;

use super::view::state::ViewState;
use svbrdf_files::source::MaterialSource;

/// How long nothing changes, in seconds, before it becomes a moment to return to.
const STABLE: f64 = 0.4;
/// Number of moments.
const MOST: usize = 100;

/// A moment to return to.
#[derive(Clone, Debug, PartialEq)]
pub struct Moment {
    pub view: ViewState,
    pub materials: Vec<MaterialSource>,
    /// The scenes of a file, where the loss is over them.
    pub scenes: Option<FileScenes>,
    /// The photograph that renderings are compared with.
    pub photograph: Option<SessionPhotograph>,
}

/// The earlier and the later moments.
#[derive(Debug, Default)]
pub struct History {
    pub undo: UndoStack<Moment>,
    /// The set of materials in the window, or the one that is being opened.
    pub materials: Vec<MaterialSource>,
}

/// Values to return to. A value counts once it has stood still: all of a drag is one step.
#[derive(Debug)]
pub struct UndoStack<T> {
    earlier: VecDeque<T>,
    later: Vec<T>,
    /// A value that has not stood still yet, and since when it is there.
    unsettled: Option<(T, f64)>,
}

impl<T> Default for UndoStack<T> {
    fn default() -> Self {
        Self { earlier: VecDeque::new(), later: Vec::new(), unsettled: None }
    }
}

impl<T: Clone + PartialEq> UndoStack<T> {
    /// Takes note of the value at this time, in seconds. Called in every frame.
    pub fn feed(&mut self, time: f64, value: &T) {
        let Some(last) = self.earlier.back() else { return self.keep(value) };
        if last == value {
            self.unsettled = None;
            return;
        }
        self.later.clear();
        match &self.unsettled {
            Some((before, _)) if before != value => self.unsettled = Some((value.clone(), time)),
            Some((_, since)) if time - since >= STABLE => self.keep(value),
            Some(_) => {}
            None => self.unsettled = Some((value.clone(), time)),
        }
    }

    /// The value before `now`.
    pub fn undo(&mut self, now: &T) -> Option<&T> {
        let is_kept = self.earlier.back() == Some(now);
        if self.earlier.len() < 1 + usize::from(is_kept) {
            return None;
        }
        self.unsettled = None;
        if is_kept {
            self.earlier.pop_back();
        }
        self.later.push(now.clone());
        self.earlier.back()
    }

    /// The value after `now`, where `now` was returned to.
    pub fn redo(&mut self, now: &T) -> Option<&T> {
        if self.earlier.back().is_some_and(|last| last != now) {
            self.later.clear();
        }
        let next = self.later.pop()?;
        self.earlier.push_back(next);
        self.earlier.back()
    }

    fn keep(&mut self, value: &T) {
        self.earlier.push_back(value.clone());
        if self.earlier.len() > MOST {
            self.earlier.pop_front();
        }
        self.unsettled = None;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Shows each of the values for a second.
    fn stack(values: &[i32]) -> (UndoStack<i32>, f64) {
        let (mut stack, mut time) = (UndoStack::default(), 0.0);
        for value in values {
            for _ in 0..10 {
                time += 0.1;
                stack.feed(time, value);
            }
        }
        (stack, time)
    }

    #[test]
    fn undo_and_redo_go_through_all_that_stood_still() {
        let (mut stack, _) = stack(&[1, 2, 3]);
        assert_eq!(
            [stack.undo(&3).copied(), stack.undo(&2).copied(), stack.undo(&1).copied()],
            [Some(2), Some(1), None]
        );
        assert_eq!(
            [stack.redo(&1).copied(), stack.redo(&2).copied(), stack.redo(&3).copied()],
            [Some(2), Some(3), None]
        );
    }

    #[test]
    fn a_change_on_the_way_is_undone_too_and_clears_what_came_after() {
        let (mut stack, time) = stack(&[1, 2]);
        stack.feed(time + 0.01, &7);
        assert_eq!(stack.undo(&7), Some(&2));
        assert_eq!(stack.redo(&2), Some(&7));
        assert_eq!(stack.undo(&7), Some(&2));
        assert_eq!(stack.redo(&5), None, "something else has changed since");
    }

    #[test]
    fn a_drag_is_one_step() {
        let mut stack = UndoStack::default();
        (0..400).for_each(|i| stack.feed(f64::from(i) * 0.1, &i.min(300)));
        assert_eq!(stack.earlier.iter().copied().collect::<Vec<_>>(), [0, 300]);
    }
}
