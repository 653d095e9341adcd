//! How much is shaded while something moves: less on an adapter that is slow, all of it at rest.

use crate::gpu::ShadeParams;

/// Seconds of a frame from which on an adapter counts as slow.
const SLOW: f32 = 0.033;
/// So many slow frames in a row, while something moves, make an adapter slow.
const FRAMES: u32 = 3;
/// Seconds without movement after which everything is shaded.
pub(super) const REST: f64 = 0.15;

/// Whether panes are shaded in full.
#[derive(Debug, Default)]
pub(super) struct Pace {
    last: Option<ShadeParams>,
    /// When the parameters changed last.
    changed: Option<f64>,
    slow_frames: u32,
}

impl Pace {
    /// Takes note of a frame at `now` that took `seconds`; returns whether it may be shaded in part.
    pub(super) fn frame(&mut self, params: ShadeParams, now: f64, seconds: f32) -> bool {
        let moves = self.last.is_some_and(|last| last != params);
        self.last = Some(params);
        let goes_on = self.changed.is_some_and(|changed| now - changed < REST);
        if moves {
            if goes_on && self.slow_frames < FRAMES {
                self.slow_frames = if seconds > SLOW { self.slow_frames + 1 } else { 0 };
            }
            self.changed = Some(now);
        }
        let rests = self.changed.is_none_or(|changed| now - changed >= REST);
        self.slow_frames >= FRAMES && !rests
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::convention::PRINTED;
    use crate::picture::quantity::Quantity;
    use crate::viewer::state::ViewState;

    fn params(x: f64) -> ShadeParams {
        let mut scene = ViewState::default().scene;
        scene.light[0] = x;
        ShadeParams { scene, convention: PRINTED, quantity: Quantity::Rendering }
    }

    #[test]
    fn a_fast_adapter_always_shades_everything() {
        let mut pace = Pace::default();
        let shaded_in_part = (0..100).any(|i| pace.frame(params(f64::from(i)), f64::from(i) * 0.016, 0.016));
        assert!(!shaded_in_part);
    }

    #[test]
    fn a_slow_adapter_shades_in_part_while_something_moves_and_everything_at_rest() {
        let mut pace = Pace::default();
        let moving: Vec<bool> =
            (0..10).map(|i| pace.frame(params(f64::from(i)), f64::from(i) * 0.1, 0.1)).collect();
        // Nothing moves in the first frame, and the second has no moving frame before it; then two of three slow ones.
        assert_eq!(moving, [[false; 4].as_slice(), &[true; 6]].concat());
        assert!(moving[9]);
        assert!(pace.frame(params(9.0), 0.95, 0.05), "it may go on");
        assert!(!pace.frame(params(9.0), 0.9 + REST + 0.01, 0.15), "at rest");
        assert!(pace.frame(params(10.0), 5.0, 4.0), "the adapter stays slow");
    }
}
