//! Snapshot of the content: the panes and the legend in a picture of any size.

use eframe::egui;

use super::WindowUi;
use super::content::CentralArea;
use super::shading::gpu_view::GpuView;
use super::shading::snapshot::{Size, snapshot};
use crate::error::Error;
use crate::jobs::displayed::Displayed;

impl WindowUi {
    /// The panes and the legend in a picture of this size, in pixels, with or without the handles of light and view.
    ///
    /// # Errors
    /// As [`snapshot`]; an internal one without an adapter.
    pub fn picture(
        &mut self,
        ctx: &egui::Context,
        displayed: Displayed<'_>,
        gpu: Option<&mut GpuView>,
        pixels: [u32; 2],
        handles: bool,
    ) -> Result<egui::ColorImage, Error> {
        let window = self.picture_size;
        // A larger picture has larger text.
        let grown =
            (pixels[0] as f32 / window[0].max(1) as f32).min(pixels[1] as f32 / window[1].max(1) as f32);
        let scale = (ctx.pixels_per_point() * grown).clamp(0.5, 8.0);
        let Some(view) = gpu else {
            return Err(Error::internal("there is no graphics adapter to draw the view"));
        };
        let (state, gpu, dark) = (view.state.clone(), view.gpu.clone(), displayed.model.settings.dark);
        for material in displayed.materials() {
            let uploaded = displayed.jobs.uploads.get(material.id());
            uploaded.into_iter().for_each(|uploaded| uploaded.complete(&gpu, material.material()));
        }
        // Gestures, controls and corner handles stay in the window.
        let displayed = Displayed { is_picture: true, hides_handles: !handles, ..displayed };
        let mut viewport = self.viewport.exact();
        // A larger picture shows the same part of the material.
        let mut magnified = displayed.model.view.clone();
        if let Some(framing) = &mut magnified.display.framing {
            framing.pixels_per_texel *= grown;
        }
        Ok(snapshot(&state, &gpu, Size { pixels, scale }, dark, |ui| {
            let (viewport, textures) = (&mut viewport, &mut self.textures);
            let mut content = CentralArea { displayed, viewport, textures, view: &magnified };
            drop(content.ui(ui, Some(view)));
        })?)
    }
}
