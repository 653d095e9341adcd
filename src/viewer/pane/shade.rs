//! How much of the materials in the panes is shaded in a frame.

use std::collections::BTreeSet;

use eframe::egui;

use svbrdf_gpu::ShadeParams;

use crate::pane::Displayed;
use crate::pane::draft::shaded_part;
use crate::pane::draft::{LARGE, PAUSE, PaneView};
use crate::pane::gpu_view::GpuView;
use crate::pane::scenery::PaneContent;
use crate::pane::shaded::{ShadedPart, ShadingRequest};
use crate::pane::viewport::Viewport;

impl Viewport {
    /// Shades every material in a pane; on a slow adapter only what the screen needs while something moves, and the rest bit by
    /// bit.
    pub(super) fn shade(
        &mut self,
        ui: &egui::Ui,
        gpu: &mut GpuView,
        shown: &Displayed<'_>,
        contents: &[PaneContent],
    ) -> Result<(), String> {
        let state = shown.view();
        let params = ShadeParams {
            scene: state.scene,
            convention: state.convention(),
            quantity: state.display.quantity,
        };
        let grid = shown.materials()[0].grid();
        let texels = grid.width * grid.height;
        let software = gpu.gpu.report.software;
        let visible = PaneView { params, framing: state.display.framing };
        let is_slow = software && texels * shown.materials().len() > LARGE;
        let moves = self.policy.moves(visible, ui.input(|i| i.time)) && is_slow;
        if moves {
            ui.ctx().request_repaint_after_secs(PAUSE as f32 + 0.01);
        }
        let is_large = texels > LARGE && software;
        // What is compared with a computed map or a photograph, and what is saved, is never shaded in part.
        let is_exact = self.is_exact || state.is_computed() || shown.photograph().is_some();
        self.is_draft = moves && !is_exact;
        let part = if self.is_draft || is_large && !is_exact {
            shaded_part(state, grid, self.pane_pixels(), self.magnification(grid, state))
        } else {
            ShadedPart::Whole
        };
        let sharpens = !moves && part != ShadedPart::Whole;
        let request = ShadingRequest {
            params,
            part,
            sharpens,
            waits: !shown.model.materials.openings.is_empty(),
            exact: is_exact,
        };
        gpu.keep_only(shown.materials(), contents.len());
        let displayed: BTreeSet<usize> = contents.iter().flat_map(|one| [one.index, one.reference]).collect();
        let materials: Vec<_> = displayed.into_iter().map(|index| &shown.materials()[index]).collect();
        if gpu.shade(&materials, request)? {
            ui.ctx().request_repaint();
        }
        Ok(())
    }
}
