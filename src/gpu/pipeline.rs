//! The parts of a pipeline that the passes share.

use std::sync::{Mutex, PoisonError};

use wgpu::util::DeviceExt as _;
use wgpu::{
    BindGroup, BindGroupEntry, BindGroupLayout, BindGroupLayoutDescriptor, BindGroupLayoutEntry,
    BindingResource, BindingType, Buffer, BufferBindingType, BufferUsages, CommandEncoder, Device, LoadOp,
    Operations, PipelineCompilationOptions, PipelineLayout, PipelineLayoutDescriptor, RenderPass,
    RenderPassColorAttachment, RenderPassDescriptor, RenderPipeline, ShaderModule, ShaderModuleDescriptor,
    ShaderSource, ShaderStages, StoreOp, TextureFormat, TextureView,
};

use svbrdf_shaders::Shader;

pub(super) fn module(device: &Device, shader: &Shader) -> ShaderModule {
    device.create_shader_module(ShaderModuleDescriptor {
        label: Some(shader.name),
        source: ShaderSource::Wgsl(shader.source().into()),
    })
}

/// A layout of one group whose bindings are `types`, in order, all seen by `visibility`.
pub(super) fn layout(device: &Device, visibility: ShaderStages, types: &[BindingType]) -> BindGroupLayout {
    let entry = |(binding, ty): (usize, &BindingType)| BindGroupLayoutEntry {
        binding: binding as u32,
        visibility,
        ty: *ty,
        count: None,
    };
    let entries: Vec<_> = types.iter().enumerate().map(entry).collect();
    device.create_bind_group_layout(&BindGroupLayoutDescriptor { label: None, entries: &entries })
}

/// The group that binds `resources`, in order.
pub(super) fn bind(
    device: &Device,
    layout: &BindGroupLayout,
    resources: &[BindingResource<'_>],
) -> BindGroup {
    let entries: Vec<_> = resources
        .iter()
        .enumerate()
        .map(|(binding, resource)| BindGroupEntry { binding: binding as u32, resource: resource.clone() })
        .collect();
    device.create_bind_group(&wgpu::BindGroupDescriptor { label: None, layout, entries: &entries })
}

/// A binding of a buffer.
pub(super) const fn buffer_type(ty: BufferBindingType) -> BindingType {
    BindingType::Buffer { ty, has_dynamic_offset: false, min_binding_size: None }
}

/// A binding of a float texture whose texels are loaded, never filtered.
pub(super) const fn texture_type() -> BindingType {
    BindingType::Texture {
        sample_type: wgpu::TextureSampleType::Float { filterable: false },
        view_dimension: wgpu::TextureViewDimension::D2,
        multisampled: false,
    }
}

/// A binding of a texture of integers.
pub(super) const fn codes_type() -> BindingType {
    BindingType::Texture {
        sample_type: wgpu::TextureSampleType::Uint,
        view_dimension: wgpu::TextureViewDimension::D2,
        multisampled: false,
    }
}

/// A uniform buffer that holds `contents` and can be written again.
pub(super) fn uniform_buffer(device: &Device, contents: &[u8]) -> Buffer {
    device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
        label: Some("uniforms"),
        contents,
        usage: BufferUsages::UNIFORM | BufferUsages::COPY_DST,
    })
}

fn pipeline_layout(device: &Device, label: &str, layout: &BindGroupLayout) -> PipelineLayout {
    device.create_pipeline_layout(&PipelineLayoutDescriptor {
        label: Some(label),
        bind_group_layouts: &[Some(layout)],
        immediate_size: 0,
    })
}

/// What a pass that draws everything begins with.
pub(super) const CLEAR: LoadOp<wgpu::Color> = LoadOp::Clear(wgpu::Color::BLACK);

/// A pass that draws into `view`.
pub(super) fn begin<'a>(
    encoder: &'a mut CommandEncoder,
    label: &str,
    view: &TextureView,
    load: LoadOp<wgpu::Color>,
) -> RenderPass<'a> {
    encoder.begin_render_pass(&RenderPassDescriptor {
        label: Some(label),
        color_attachments: &[Some(RenderPassColorAttachment {
            view,
            resolve_target: None,
            depth_slice: None,
            ops: Operations { load, store: StoreOp::Store },
        })],
        ..RenderPassDescriptor::default()
    })
}

/// The constants of a pipeline: what its shader overrides, and with what.
pub(super) type Constants = Vec<(&'static str, u32)>;

/// Most choices of constants whose pipelines are kept: a frame needs a few of the hundreds, and each takes about a megabyte on
/// adapters that compute on the CPU.
const MOST_PIPELINES: usize = 24;

/// Pipelines that cover their target with one triangle and run the fragment function called like their shader; one for each of the
/// latest choices of the shader's constants, compiled when it is needed.
#[derive(Debug)]
pub(super) struct Fullscreen {
    shader: &'static Shader,
    pub layout: BindGroupLayout,
    target: TextureFormat,
    /// The latest used last.
    compiled: Mutex<Vec<(Constants, RenderPipeline)>>,
}

impl Fullscreen {
    /// For groups whose bindings are `types`. A choice is compiled at once, whose faults are those of all.
    pub(super) fn new(
        device: &Device,
        shader: &'static Shader,
        types: &[BindingType],
        target: TextureFormat,
        first: Constants,
    ) -> Self {
        let layout = layout(device, ShaderStages::FRAGMENT, types);
        let all = Self { shader, layout, target, compiled: Mutex::default() };
        all.with(device, first);
        all
    }

    /// The pipeline with these constants.
    pub(super) fn with(&self, device: &Device, constants: Constants) -> RenderPipeline {
        let mut compiled = self.compiled.lock().unwrap_or_else(PoisonError::into_inner);
        let pipeline = match compiled.iter().position(|(of, _)| *of == constants) {
            Some(place) => compiled.remove(place).1,
            None => self.compile(device, &constants),
        };
        compiled.push((constants, pipeline.clone()));
        let oldest = compiled.len().saturating_sub(MOST_PIPELINES);
        compiled.drain(..oldest);
        pipeline
    }

    fn compile(&self, device: &Device, constants: &Constants) -> RenderPipeline {
        let name = self.shader.name;
        let module = module(device, self.shader);
        let layout = pipeline_layout(device, name, &self.layout);
        let constants: Vec<(&str, f64)> = constants.iter().map(|(name, v)| (*name, f64::from(*v))).collect();
        let fragment_options =
            PipelineCompilationOptions { constants: &constants, ..PipelineCompilationOptions::default() };
        device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some(name),
            layout: Some(&layout),
            vertex: wgpu::VertexState {
                module: &module,
                entry_point: Some("cover"),
                compilation_options: Default::default(),
                buffers: &[],
            },
            primitive: wgpu::PrimitiveState::default(),
            depth_stencil: None,
            multisample: wgpu::MultisampleState::default(),
            fragment: Some(wgpu::FragmentState {
                module: &module,
                entry_point: Some(name),
                compilation_options: fragment_options,
                targets: &[Some(self.target.into())],
            }),
            multiview_mask: None,
            cache: None,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use svbrdf_shaders as shaders;

    use crate::Gpu;

    #[test]
    fn the_latest_pipelines_are_kept_and_no_more() {
        let gpu = match Gpu::headless() {
            Ok(gpu) => gpu,
            Err(error) => return eprintln!("NOT TESTED: {error}"),
        };
        let types = [buffer_type(BufferBindingType::Uniform), texture_type(), texture_type(), texture_type()];
        let format = gpu.report.shading_format;
        let all = Fullscreen::new(&gpu.device, &shaders::FLOATS.reduce, &types, format, Constants::new());
        let count = || all.compiled.lock().unwrap().len();
        // The shader has no such constants, which is a fault of the device, but none of the list.
        let with = |number: usize| {
            let _ = crate::fault::scoped(&gpu.device, "testing", || {
                all.with(&gpu.device, vec![("NONE", number as u32)]);
            });
        };
        (0..2 * MOST_PIPELINES).for_each(with);
        assert_eq!(count(), MOST_PIPELINES);
        let first = |number: usize| all.compiled.lock().unwrap()[number].0.clone();
        let oldest = first(0)[0].1 as usize;
        with(oldest);
        assert_eq!(first(MOST_PIPELINES - 1), [("NONE", oldest as u32)], "it was used last");
        assert_eq!(count(), MOST_PIPELINES);
    }
}
