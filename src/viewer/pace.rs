//! How much is shaded while something moves: less on an adapter that is slow, all of it at rest.

use crate::gpu::ShadeParams;

/// Seconds of a frame from which on an adapter counts as slow. Some screens show 30 frames a second.
const SLOW: f32 = 0.036;
/// So many slow frames in a row, while something moves, make an adapter slow.
const FRAMES: u32 = 3;
/// The same of an adapter that computes on the CPU.
const FRAMES_OF_SOFTWARE: u32 = 1;
/// Seconds without movement after which everything is shaded.
pub(super) const REST: f64 = 0.15;

/// What moves: the scene, or the section of the material that is seen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct PaneView {
    pub params: ShadeParams,
    pub zoom: f32,
    pub pan: [f32; 2],
}

/// Whether panes are shaded in full.
#[derive(Debug, Default)]
pub(super) struct Pace {
    last: Option<PaneView>,
    /// When something moved last.
    changed: Option<f64>,
    slow_frames: u32,
    is_slow: bool,
}

impl Pace {
    /// Takes note of a frame at `now`, `seconds` after the one before; returns whether it may be shaded in part.
    ///
    /// What a person moves is moved at the end of a frame, which asks for the next one at once. So where something has moved,
    /// `seconds` is the time of a frame, and none of it was spent waiting for the person.
    pub(super) fn frame(&mut self, seen: PaneView, now: f64, seconds: f32, software: bool) -> bool {
        let moves = self.last.is_some_and(|last| last != seen);
        self.last = Some(seen);
        if moves {
            self.slow_frames = if seconds > SLOW { self.slow_frames + 1 } else { 0 };
            self.is_slow |= self.slow_frames >= if software { FRAMES_OF_SOFTWARE } else { FRAMES };
            self.changed = Some(now);
        }
        let rests = self.changed.is_none_or(|changed| now - changed >= REST);
        self.is_slow && !rests
    }

    /// Whether the adapter has been found slow.
    pub(super) fn is_slow(&self) -> bool {
        self.is_slow
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::convention::PRINTED;
    use crate::picture::quantity::Quantity;
    use crate::viewer::state::ViewState;

    fn seen(x: f64) -> PaneView {
        let mut scene = ViewState::default().scene;
        scene.light[0] = x;
        let params = ShadeParams { scene, convention: PRINTED, quantity: Quantity::Rendering };
        PaneView { params, zoom: 1.0, pan: [0.0; 2] }
    }

    /// Frames in which the light moves, each of them as long: which of them may be shaded in part.
    fn moving(pace: &mut Pace, frames: usize, seconds: f64, software: bool) -> Vec<bool> {
        let frame = |i| pace.frame(seen(i as f64), i as f64 * seconds, seconds as f32, software);
        (0..frames).map(frame).collect()
    }

    #[test]
    fn a_fast_adapter_always_shades_everything() {
        for seconds in [0.004, 1.0 / 60.0, 1.0 / 30.0] {
            for software in [false, true] {
                let parts = moving(&mut Pace::default(), 100, seconds, software);
                assert!(!parts.contains(&true), "{seconds} {software}");
            }
        }
        // Two late frames are no slow adapter.
        let mut pace = Pace::default();
        let late = |i: usize| if [20, 21, 40, 41].contains(&i) { 0.2 } else { 0.016 };
        assert!(!(0..60).any(|i| pace.frame(seen(i as f64), i as f64 * 0.016, late(i), false)));
    }

    #[test]
    fn a_slow_adapter_shades_in_part_while_something_moves_and_everything_at_rest() {
        // However long its frames are.
        for seconds in [0.05, 0.1, 0.4, 2.0] {
            let mut pace = Pace::default();
            // Nothing moves in the first frame.
            let expected = [[false; 3].as_slice(), &[true; 7]].concat();
            assert_eq!(moving(&mut pace, 10, seconds, false), expected, "{seconds}");
            let last = 9.0 * seconds;
            assert!(pace.frame(seen(9.0), last + 0.05, 0.05, false), "it may go on");
            assert!(!pace.frame(seen(9.0), last + REST + 0.01, 0.15, false), "at rest");
            assert!(pace.frame(seen(10.0), last + 5.0, 0.016, false), "the adapter stays slow");
        }
        assert_eq!(moving(&mut Pace::default(), 4, 0.1, true), [false, true, true, true], "software");
    }

    #[test]
    fn the_section_that_is_seen_moves_as_the_scene_does() {
        for next in [PaneView { zoom: 1.15, ..seen(0.0) }, PaneView { pan: [0.1, 0.0], ..seen(0.0) }] {
            let mut pace = Pace { is_slow: true, ..Pace::default() };
            assert!(!pace.frame(seen(0.0), 0.0, 0.02, false));
            assert!(pace.frame(next, 1.0, 0.02, false), "{next:?}");
        }
    }
}
