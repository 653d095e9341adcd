//! The pixels of a pane, kept until what they show changes.

use wgpu::{
    BindGroup, BindGroupLayout, BindingResource, Extent3d, RenderPass, RenderPipeline, Texture,
    TextureDescriptor, TextureFormat, TextureUsages,
};

use svbrdf_core::error::Error;
use svbrdf_shaders as shaders;

use super::fault::scoped;
use super::pipeline::{CLEAR, Constants, Fullscreen, begin, bind, texture_type};
use super::{Gpu, Pane};

/// The pipeline that copies kept pixels to the window.
#[derive(Debug)]
pub struct Blit {
    pipeline: RenderPipeline,
    layout: BindGroupLayout,
    format: TextureFormat,
}

/// A pane's pixels.
#[derive(Debug)]
pub struct Still {
    texture: Texture,
    group: BindGroup,
}

impl Still {
    /// Draws `pane` into these pixels, and submits that.
    pub fn draw(&self, gpu: &Gpu, pane: &Pane) {
        let view = self.texture.create_view(&Default::default());
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        let mut pass = begin(&mut encoder, "pane", &view, CLEAR);
        pane.draw(&mut pass);
        drop(pass);
        gpu.queue.submit([encoder.finish()]);
    }
}

impl Blit {
    /// Compiles the shader for the window's format.
    ///
    /// # Errors
    /// [`Error::Gpu`] where the driver refuses.
    pub fn new(gpu: &Gpu, format: TextureFormat) -> Result<Self, Error> {
        scoped(&gpu.device, "compiling the copy of panes", || {
            let none = Constants::new;
            let pipelines = Fullscreen::new(&gpu.device, &shaders::BLIT, &[texture_type()], format, none());
            Self { pipeline: pipelines.with(&gpu.device, none()), layout: pipelines.layout, format }
        })
    }

    /// Room for the pixels of a pane.
    pub fn still(&self, gpu: &Gpu, [width, height]: [u32; 2]) -> Still {
        let texture = gpu.device.create_texture(&TextureDescriptor {
            label: Some("pane"),
            size: Extent3d { width, height, depth_or_array_layers: 1 },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: self.format,
            usage: TextureUsages::RENDER_ATTACHMENT | TextureUsages::TEXTURE_BINDING,
            view_formats: &[],
        });
        let view = texture.create_view(&Default::default());
        let group = bind(&gpu.device, &self.layout, &[BindingResource::TextureView(&view)]);
        Still { texture, group }
    }

    /// Copies the pixels over the viewport of `pass`, which has their size.
    pub fn draw(&self, pass: &mut RenderPass<'_>, still: &Still) {
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, &still.group, &[]);
        pass.draw(0..3, 0..1);
    }
}
