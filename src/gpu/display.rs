//! Pass 2: what the camera sees of shaded texels, encoded for the screen, one fragment per pixel.

use wgpu::{
    BindGroup, BindGroupLayout, BindingResource, Buffer, BufferBindingType, Queue, RenderPass,
    RenderPipeline, ShaderStages, TextureFormat,
};

use super::fault::scoped;
use super::pipeline::{bind, buffer_type, fullscreen, layout, texture_type, uniform_buffer};
use super::{Gpu, Shaded, shaders, uniforms};
use crate::error::Error;
use crate::picture::camera::Camera;
use crate::picture::difference::Difference;
use crate::picture::quantity::Quantity;

/// How a pane shows its pictures.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DisplayParams {
    pub camera: Camera,
    /// Radiance is multiplied by 2 to this power.
    pub exposure_ev: f32,
    pub mode: DisplayMode,
    /// The difference of the first picture from the reference, shown in place of the first; both have the same size.
    pub difference: Option<DisplayedDifference>,
    pub encoding: Encoding,
    /// Stripes pixels of [`Encoding::Radiance`] that are too bright in a channel (magenta) or black (blue).
    pub show_clipping: bool,
    /// Epsilon of the difference's logarithms: that of the convention.
    pub epsilon: f32,
    /// What is shown beside the material, already encoded for the screen.
    pub background: [f32; 3],
}

/// Which of a pane's two pictures is shown where.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum DisplayMode {
    /// The first.
    Value,
    /// The reference left of this x of the pane, which runs from -1 to 1, and the first right of it.
    Wipe(f32),
}

/// A difference shown as colours: [`heat`](crate::picture::colour_map::heat), or
/// [`diverging`](crate::picture::colour_map::diverging) where it is signed. Exposure does not change it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DisplayedDifference {
    pub kind: Difference,
    /// The difference that has the last colour; positive.
    pub range: f32,
}

/// How numbers become colours of the screen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Encoding {
    /// Exposed, then sRGB.
    Radiance,
    /// sRGB, never exposed.
    Albedo,
    /// As they are.
    Data,
}

impl From<Quantity> for Encoding {
    fn from(quantity: Quantity) -> Self {
        match quantity {
            Quantity::Rendering => Self::Radiance,
            Quantity::Diffuse | Quantity::Specular => Self::Albedo,
            Quantity::Normal | Quantity::Roughness => Self::Data,
        }
    }
}

/// The pipeline of pass 2.
#[derive(Debug)]
pub struct Display {
    pipeline: RenderPipeline,
    layout: BindGroupLayout,
}

/// Two pictures and how they are shown; as many as there are panes.
#[derive(Debug)]
pub struct Pane {
    uniforms: Buffer,
    group: BindGroup,
}

impl Pane {
    /// Sets how the next frame shows the pane.
    pub fn write(&self, queue: &Queue, params: &DisplayParams) {
        queue.write_buffer(&self.uniforms, 0, bytemuck::bytes_of(&uniforms::Display::from(params)));
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

    /// A pane of two pictures; the same one twice where there is no reference. Shows nothing before
    /// [`Pane::write`]. A failure waits in [`Gpu::take_fault`].
    pub fn pane(&self, gpu: &Gpu, shown: &Shaded, reference: &Shaded) -> Pane {
        let uniforms = uniform_buffer(&gpu.device, &[0; size_of::<uniforms::Display>()]);
        let resources = [
            uniforms.as_entire_binding(),
            BindingResource::TextureView(&shown.view),
            BindingResource::TextureView(&reference.view),
        ];
        let group = bind(&gpu.device, &self.layout, &resources);
        Pane { uniforms, group }
    }

    /// Draws `pane` over the viewport of `pass`, which is the pane's rectangle.
    pub fn draw(&self, pass: &mut RenderPass<'_>, pane: &Pane) {
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, &pane.group, &[]);
        pass.draw(0..3, 0..1);
    }
}
