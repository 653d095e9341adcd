//! Pass 2: what the camera sees of shaded texels, encoded for the screen, one fragment per pixel.

use wgpu::{
    BindGroup, BindGroupLayout, BindingResource, Buffer, BufferBindingType, Queue, RenderPass,
    RenderPipeline, ShaderStages, TextureFormat,
};

use super::fault::scoped;
use super::params::DisplayParams;
use super::pipeline::{bind, buffer_type, fullscreen, layout, texture_type, uniform_buffer};
use super::uniforms::DisplayUniforms;
use super::{Gpu, Shaded, shaders};
use crate::error::Error;

/// The pipeline of pass 2.
#[derive(Debug)]
pub struct Display {
    pipeline: RenderPipeline,
    layout: BindGroupLayout,
}

/// Two pictures and how they are shown; as many as there are panes.
#[derive(Debug)]
pub struct Pane {
    /// Of the materials, and how many of their texels along an axis make one of the pictures.
    size: [usize; 2],
    stride: usize,
    uniforms: Buffer,
    group: BindGroup,
}

impl Pane {
    /// Sets how the next frame shows the pane.
    pub fn write(&self, queue: &Queue, params: &DisplayParams) {
        queue.write_buffer(
            &self.uniforms,
            0,
            bytemuck::bytes_of(&DisplayUniforms::new(params, self.size, self.stride)),
        );
    }
}

impl Display {
    /// Compiles the shader for a target that does not encode by itself, as egui's.
    ///
    /// # Errors
    /// [`Error::Gpu`] where the target encodes sRGB itself, or the driver refuses.
    pub fn new(gpu: &Gpu, target_format: TextureFormat) -> Result<Self, Error> {
        if target_format.is_srgb() {
            return Err(Error::Gpu {
                problem: format!(
                    "the window's format is {target_format:?}, which encodes sRGB a second time"
                ),
                remedy: "choose another backend with WGPU_BACKEND",
            });
        }
        scoped(&gpu.device, "compiling the display pass", || {
            let types = [buffer_type(BufferBindingType::Uniform), texture_type(), texture_type()];
            let layout = layout(&gpu.device, ShaderStages::FRAGMENT, &types);
            let pipeline = fullscreen(&gpu.device, &shaders::DISPLAY, &layout, target_format);
            Self { pipeline, layout }
        })
    }

    /// A pane of two pictures of one size and stride; the same one twice where there is no reference. Shows nothing before
    /// [`Pane::write`]. A failure waits in [`Gpu::take_fault`].
    pub fn pane(&self, gpu: &Gpu, shown: &Shaded, reference: &Shaded) -> Pane {
        let uniforms = uniform_buffer(&gpu.device, &[0; size_of::<DisplayUniforms>()]);
        let resources = [
            uniforms.as_entire_binding(),
            BindingResource::TextureView(&shown.view),
            BindingResource::TextureView(&reference.view),
        ];
        let group = bind(&gpu.device, &self.layout, &resources);
        Pane { size: shown.size(), stride: shown.stride(), uniforms, group }
    }

    /// Draws `pane` over the viewport of `pass`, which is the pane's rectangle.
    pub fn draw(&self, pass: &mut RenderPass<'_>, pane: &Pane) {
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, &pane.group, &[]);
        pass.draw(0..3, 0..1);
    }
}
