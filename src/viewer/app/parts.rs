//! Parts of the application: the model, the jobs, the user interface and the adapter.

use crate::jobs::Jobs;
use crate::jobs::displayed::Displayed;
use crate::model::Model;
use crate::ui::WindowUi;
use crate::ui::shading::gpu_view::GpuView;

/// What effects and results change.
#[derive(Debug)]
pub struct Parts {
    pub model: Model,
    pub jobs: Jobs,
    pub ui: WindowUi,
    /// `None` where there is no adapter.
    pub gpu: Option<GpuView>,
}

impl Parts {
    /// What the panes display.
    pub fn displayed(&self) -> Displayed<'_> {
        Displayed::of(&self.model, &self.jobs)
    }
}
