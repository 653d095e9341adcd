//! Inputs shared by the background jobs of the current view.

use std::sync::Arc;

use svbrdf_gpu::Gpu;

use crate::jobs::work::waker::Waker;
use crate::model::material::loaded::LoadedMaterial;
use crate::model::material::read::ReadMaterial;
use crate::model::view::ViewState;

/// The materials and the view of one frame, for jobs that follow them.
#[derive(Clone, Copy, Debug)]
pub struct JobContext<'a> {
    pub waker: &'a Waker,
    /// `None` where there is no adapter.
    pub gpu: Option<&'a Gpu>,
    /// The ground truth first, then the predictions.
    pub materials: &'a [LoadedMaterial],
    pub view: &'a ViewState,
}

impl JobContext<'_> {
    /// The materials, for a worker.
    pub fn materials(&self) -> Vec<Arc<ReadMaterial>> {
        self.materials.iter().map(|one| one.read.clone()).collect()
    }
}
