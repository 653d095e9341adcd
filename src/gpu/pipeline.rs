//! The parts of a pipeline that the passes and the probe share.

use wgpu::util::DeviceExt as _;
use wgpu::{
    BindGroup, BindGroupEntry, BindGroupLayout, BindGroupLayoutDescriptor, BindGroupLayoutEntry,
    BindingResource, BindingType, Buffer, BufferBindingType, BufferUsages, ComputePipeline, Device,
    PipelineLayout, PipelineLayoutDescriptor, RenderPipeline, ShaderModule, ShaderModuleDescriptor,
    ShaderSource, ShaderStages, TextureFormat,
};

use super::shaders::Shader;

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
pub(super) fn buffer_type(ty: BufferBindingType) -> BindingType {
    BindingType::Buffer { ty, has_dynamic_offset: false, min_binding_size: None }
}

/// A binding of a float texture whose texels are loaded, never filtered.
pub(super) fn texture_type() -> BindingType {
    BindingType::Texture {
        sample_type: wgpu::TextureSampleType::Float { filterable: false },
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

/// A pipeline that runs the compute function `entry` of `module`.
pub(super) fn compute(
    device: &Device,
    module: &ShaderModule,
    entry: &str,
    layout: &BindGroupLayout,
) -> ComputePipeline {
    let layout = pipeline_layout(device, entry, layout);
    device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
        label: Some(entry),
        layout: Some(&layout),
        module,
        entry_point: Some(entry),
        compilation_options: Default::default(),
        cache: None,
    })
}

fn pipeline_layout(device: &Device, label: &str, layout: &BindGroupLayout) -> PipelineLayout {
    device.create_pipeline_layout(&PipelineLayoutDescriptor {
        label: Some(label),
        bind_group_layouts: &[Some(layout)],
        immediate_size: 0,
    })
}

/// A pipeline that covers its target with one triangle and runs the fragment function called like `shader`.
pub(super) fn fullscreen(
    device: &Device,
    shader: &Shader,
    layout: &BindGroupLayout,
    target: TextureFormat,
) -> RenderPipeline {
    let module = module(device, shader);
    let layout = pipeline_layout(device, shader.name, layout);
    device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some(shader.name),
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
            entry_point: Some(shader.name),
            compilation_options: Default::default(),
            targets: &[Some(target.into())],
        }),
        multiview_mask: None,
        cache: None,
    })
}
