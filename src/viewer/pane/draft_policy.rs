//! Draft policy: how much is shaded while something moves; less on a slow adapter, everything after a pause.

use svbrdf_files::session::window::Framing;
use svbrdf_gpu::ShadeParams;

/// Seconds of a frame from which on an adapter counts as slow. Some screens show 30 frames a second.
const SLOW: f32 = 0.036;
/// So many slow frames in a row, while something moves, make an adapter slow.
const FRAMES: u32 = 3;
/// The same of an adapter that computes on the CPU.
const FRAMES_OF_SOFTWARE: u32 = 1;
/// Seconds without movement after which everything is shaded.
pub const PAUSE: f64 = 0.15;

/// What moves: the scene, or the section of the material that is seen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PaneView {
    pub params: ShadeParams,
    pub framing: Option<Framing>,
}

/// Whether panes are shaded in full.
#[derive(Debug, Default)]
pub struct DraftPolicy {
    last: Option<PaneView>,
    /// When something moved last.
    changed: Option<f64>,
    slow_frames: u32,
    is_slow: bool,
}

impl DraftPolicy {
    /// Takes note of a frame at `now`, `seconds` after the one before; returns whether it may be shaded in part.
    ///
    /// A frame in which something moves asks for the next one at once. `seconds` is the time between two such frames, and a guess
    /// where the one before did not ask: no time of waiting counts.
    pub fn frame(&mut self, visible: PaneView, now: f64, seconds: f32, software: bool) -> bool {
        let moves = self.last.is_some_and(|last| last != visible);
        self.last = Some(visible);
        if moves {
            self.slow_frames = if seconds > SLOW { self.slow_frames + 1 } else { 0 };
            self.is_slow |= self.slow_frames >= if software { FRAMES_OF_SOFTWARE } else { FRAMES };
            self.changed = Some(now);
        }
        let pauses = self.changed.is_none_or(|changed| now - changed >= PAUSE);
        self.is_slow && !pauses
    }

    /// Whether the adapter has been found slow.
    pub fn is_slow(&self) -> bool {
        self.is_slow
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::view::ViewState;
    use svbrdf_core::model::convention::PRINTED;
    use svbrdf_core::picture::quantity::Quantity;

    fn view(x: f64) -> PaneView {
        let mut scene = ViewState::default().scene;
        scene.light[0] = x;
        let params = ShadeParams { scene, convention: PRINTED, quantity: Quantity::Rendering };
        PaneView { params, framing: None }
    }

    /// Frames in which the light moves, each of them as long: which of them may be shaded in part.
    fn moving(policy: &mut DraftPolicy, frames: usize, seconds: f64, software: bool) -> Vec<bool> {
        let frame = |i| policy.frame(view(i as f64), i as f64 * seconds, seconds as f32, software);
        (0..frames).map(frame).collect()
    }

    #[test]
    fn a_fast_adapter_always_shades_everything() {
        for seconds in [0.004, 1.0 / 60.0, 1.0 / 30.0] {
            for software in [false, true] {
                let parts = moving(&mut DraftPolicy::default(), 100, seconds, software);
                assert!(!parts.contains(&true), "{seconds} {software}");
            }
        }
        // Two late frames are no slow adapter.
        let mut policy = DraftPolicy::default();
        let late = |i: usize| if [20, 21, 40, 41].contains(&i) { 0.2 } else { 0.016 };
        assert!(!(0..60).any(|i| policy.frame(view(i as f64), i as f64 * 0.016, late(i), false)));
    }

    #[test]
    fn a_slow_adapter_shades_in_part_while_something_moves_and_everything_at_rest() {
        // However long its frames are.
        for seconds in [0.05, 0.1, 0.4, 2.0] {
            let mut policy = DraftPolicy::default();
            // Nothing moves in the first frame.
            let expected = [[false; 3].as_slice(), &[true; 7]].concat();
            assert_eq!(moving(&mut policy, 10, seconds, false), expected, "{seconds}");
            let last = 9.0 * seconds;
            assert!(policy.frame(view(9.0), last + 0.05, 0.05, false), "it may go on");
            assert!(!policy.frame(view(9.0), last + PAUSE + 0.01, 0.15, false), "at rest");
            assert!(policy.frame(view(10.0), last + 5.0, 0.016, false), "the adapter stays slow");
        }
        assert_eq!(moving(&mut DraftPolicy::default(), 4, 0.1, true), [false, true, true, true], "software");
    }

    #[test]
    fn the_section_that_is_seen_moves_as_the_scene_does() {
        let framing = |pixels_per_texel, x| Some(Framing { pixels_per_texel, centre: [x, 2.0] });
        for framing in [framing(1.15, 2.0), framing(1.15, 2.1)] {
            let next = PaneView { framing, ..view(0.0) };
            let mut policy = DraftPolicy { is_slow: true, ..DraftPolicy::default() };
            assert!(!policy.frame(view(0.0), 0.0, 0.02, false));
            assert!(policy.frame(next, 1.0, 0.02, false), "{next:?}");
        }
    }
}
