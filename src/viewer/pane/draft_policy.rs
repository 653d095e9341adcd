//! Draft policy: how much is shaded while something moves; less on an adapter that computes on the CPU, everything after a pause.

use svbrdf_files::session::window::Framing;
use svbrdf_gpu::ShadeParams;

/// Texels of all materials that software shades within a frame.
pub const LARGE: usize = 1 << 19;
/// Seconds without movement after which everything is shaded.
pub const PAUSE: f64 = 0.15;

/// What moves: the scene, or the section of the material that is seen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PaneView {
    pub params: ShadeParams,
    pub framing: Option<Framing>,
}

/// When something moved last.
#[derive(Debug, Default)]
pub struct DraftPolicy {
    last: Option<PaneView>,
    changed: Option<f64>,
}

impl DraftPolicy {
    /// Whether something moves in a frame at `now`, or has moved a moment ago.
    pub fn moves(&mut self, visible: PaneView, now: f64) -> bool {
        if self.last.replace(visible).is_some_and(|last| last != visible) {
            self.changed = Some(now);
        }
        self.changed.is_some_and(|changed| now - changed < PAUSE)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::view::ViewState;
    use svbrdf_core::model::convention::PRINTED;
    use svbrdf_core::picture::quantity::Quantity;

    #[test]
    fn a_light_or_a_section_that_changes_moves_until_a_pause() {
        let scene = ViewState::default().scene;
        let params = ShadeParams { scene, convention: PRINTED, quantity: Quantity::Rendering };
        let still = PaneView { params, framing: None };
        let mut lit = still;
        lit.params.scene.light[0] = 0.7;
        let framing = Some(Framing { pixels_per_texel: 1.15, centre: [2.0; 2] });
        for next in [lit, PaneView { framing, ..still }] {
            let mut policy = DraftPolicy::default();
            assert!(!policy.moves(still, 0.0) && !policy.moves(still, 1.0));
            assert!(policy.moves(next, 2.0) && policy.moves(next, 2.1), "it may go on");
            assert!(!policy.moves(next, 2.11 + PAUSE), "at rest");
        }
    }
}
