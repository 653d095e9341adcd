//! What the work on what is shown begins with.

use std::sync::Arc;

use eframe::egui;

use super::loaded::Loaded;
use super::slot::Slot;
use super::state::ViewState;
use crate::gpu::Gpu;

/// The materials and the view of one frame, for work that follows them on a worker.
#[derive(Clone, Copy, Debug)]
pub(super) struct WorkContext<'a> {
    /// Is asked for a frame when the work ends.
    pub ctx: &'a egui::Context,
    /// `None` where there is no adapter.
    pub gpu: Option<&'a Gpu>,
    /// The ground truth first, then the predictions.
    pub slots: &'a [Slot],
    pub state: &'a ViewState,
}

impl WorkContext<'_> {
    /// The materials, for a worker.
    pub(super) fn materials(&self) -> Vec<Arc<Loaded>> {
        self.slots.iter().map(|slot| slot.loaded.clone()).collect()
    }
}
