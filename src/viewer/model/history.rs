//! History of the model: earlier moments to return to, as many as 100.

use std::collections::VecDeque;

use svbrdf_core::loss::FileScenes;
use svbrdf_files::photograph::SessionPhotograph;

use super::view::state::{AutoExposure, ViewState};
use svbrdf_files::source::MaterialSource;

/// How long nothing changes, in seconds, before it becomes a moment to return to.
const STABLE: f64 = 0.4;
/// How long something changes without a break, in seconds, before a moment on the way is kept.
const LONG: f64 = 30.0;
/// Number of moments.
const MOST: usize = 100;

/// A moment to return to.
#[derive(Clone, Debug, PartialEq)]
pub struct Moment {
    pub view: ViewState,
    pub materials: Vec<MaterialSource>,
    /// The scenes of a file, where the loss is over them.
    pub scenes: Option<FileScenes>,
    /// The photograph that renderings are compared with, and its corners.
    pub photograph: Option<SessionPhotograph>,
}

/// A value of several parts: changes of different parts are different steps.
pub trait MomentParts {
    /// Which parts differ, a bit for each.
    fn changed(&self, other: &Self) -> u32;
}

impl MomentParts for Moment {
    fn changed(&self, other: &Self) -> u32 {
        let (a, b) = (&self.view, &other.view);
        let (c, d) = (&a.display, &b.display);
        // An exposure that follows the light is no step of its own.
        let follows = c.auto_exposure == AutoExposure::Follow;
        let exposed = c.auto_exposure != d.auto_exposure || !follows && a.exposure_ev != b.exposure_ev;
        let parts = [
            a.scene.light != b.scene.light,
            a.scene.view != b.scene.view,
            a.scene.kind != b.scene.kind,
            a.convention != b.convention,
            exposed,
            c.quantity != d.quantity,
            c.difference != d.difference,
            c.differences != d.differences,
            c.layout != d.layout,
            c.projection != d.projection,
            c.show_clipping != d.show_clipping,
            c.tiled != d.tiled,
            c.false_colour != d.false_colour,
            c.wipe != d.wipe,
            c.framing != d.framing,
            c.prediction != d.prediction,
            (c.isolated, c.only_right, c.corrected) != (d.isolated, d.only_right, d.corrected),
            self.materials != other.materials,
            self.scenes != other.scenes,
            self.photograph != other.photograph,
        ];
        parts.iter().rev().fold(0, |bits, differs| bits << 1 | u32::from(*differs))
    }
}

/// The earlier and the later moments.
#[derive(Debug, Default)]
pub struct History {
    pub undo: UndoStack<Moment>,
    /// The set of materials in the window, or the one that is being opened.
    pub materials: Vec<MaterialSource>,
}

/// Values to return to. A value counts once it has stood still, or another part of it changes: all of a drag is one step, and
/// two keys pressed in a row are two.
#[derive(Debug)]
pub struct UndoStack<T> {
    earlier: VecDeque<T>,
    later: Vec<T>,
    change: Option<UnsettledValue<T>>,
}

/// A value that has changed and has not stood still yet.
#[derive(Debug)]
struct UnsettledValue<T> {
    began: f64,
    latest: f64,
    value: T,
}

impl<T> Default for UndoStack<T> {
    fn default() -> Self {
        Self { earlier: VecDeque::new(), later: Vec::new(), change: None }
    }
}

impl<T: Clone + PartialEq + MomentParts> UndoStack<T> {
    /// Takes note of the value at this time, in seconds. Called in every frame.
    pub fn feed(&mut self, time: f64, value: &T) {
        let Some(last) = self.earlier.back() else { return self.keep(value) };
        if last == value {
            self.change = None;
            return;
        }
        self.later.clear();
        if let Some(UnsettledValue { value: before, .. }) = &self.change
            && value.changed(before) & !before.changed(last) != 0
        {
            let before = before.clone();
            self.keep(&before);
        }
        match &mut self.change {
            None => self.change = Some(UnsettledValue { began: time, latest: time, value: value.clone() }),
            Some(change) if change.value == *value => {
                if time - change.latest >= STABLE {
                    self.keep(value);
                }
            }
            Some(change) if time - change.began >= LONG => self.keep(value),
            Some(change) => (change.latest, change.value) = (time, value.clone()),
        }
    }

    /// The value before `now`.
    pub fn undo(&mut self, now: &T) -> Option<&T> {
        let is_kept = self.earlier.back() == Some(now);
        if self.earlier.len() < 1 + usize::from(is_kept) {
            return None;
        }
        self.change = None;
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
        self.change = None;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    impl MomentParts for i32 {
        fn changed(&self, other: &Self) -> u32 {
            u32::from(self != other)
        }
    }

    impl MomentParts for (i32, bool) {
        fn changed(&self, other: &Self) -> u32 {
            u32::from(self.0 != other.0) | u32::from(self.1 != other.1) << 1
        }
    }

    #[test]
    fn unlike_changes_are_steps_of_their_own_however_quick() {
        let mut stack = UndoStack::default();
        let values = [(0, false), (1, false), (2, false), (2, true), (3, true)];
        values.iter().enumerate().for_each(|(i, value)| stack.feed(i as f64 * 0.05, value));
        assert_eq!(stack.undo(&(3, true)), Some(&(2, true)));
        assert_eq!(stack.undo(&(2, true)), Some(&(2, false)), "two like changes in a row are one");
        assert_eq!(stack.undo(&(2, false)), Some(&(0, false)));
    }

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
    fn a_drag_is_one_step_and_a_long_one_several() {
        let mut stack = UndoStack::default();
        (0..400).for_each(|i| stack.feed(f64::from(i) * 0.1, &i));
        assert_eq!(stack.earlier.iter().copied().collect::<Vec<_>>(), [0, 301]);
    }
}
