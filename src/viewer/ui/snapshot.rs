//! Snapshot of the content: the panes and the legend in a picture of their size in the window, above a caption.

use eframe::egui;

use super::WindowUi;
use super::content::{self, CAPTION};
use super::shading::gpu_view::GpuView;
use super::shading::snapshot::snapshot;
use crate::error::Error;
use crate::jobs::displayed::Displayed;

impl WindowUi {
    /// The panes and the legend in a picture.
    ///
    /// # Errors
    /// As [`snapshot`]; an internal one without an adapter.
    pub fn picture(
        &mut self,
        ctx: &egui::Context,
        displayed: Displayed<'_>,
        gpu: Option<&mut GpuView>,
    ) -> Result<egui::ColorImage, Error> {
        let Some(view) = gpu else {
            return Err(Error::internal("there is no graphics adapter to draw the view"));
        };
        let (state, gpu, dark) = (view.state.clone(), view.gpu.clone(), displayed.model.settings.dark);
        for material in displayed.materials() {
            let uploaded = displayed.jobs.uploads.get(material.id());
            uploaded.into_iter().for_each(|uploaded| uploaded.complete(&gpu, material.material()));
        }
        // Gestures and controls stay in the window.
        let displayed = Displayed { is_picture: true, ..displayed };
        let mut viewport = self.viewport.exact();
        let scale = ctx.pixels_per_point();
        let [width, height] = self.picture_size;
        let size = [width, height + (CAPTION * scale) as u32];
        Ok(snapshot(&state, &gpu, (size, scale), dark, |ui| {
            content::ui(ui, displayed, &mut displayed.model.clone(), &mut viewport, Some(view));
        })?)
    }
}
