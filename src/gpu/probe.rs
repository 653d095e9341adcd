//! The shader's BRDF at single points: what holds it against its Rust twin.

use wgpu::util::{BufferInitDescriptor, DeviceExt as _};
use wgpu::{BufferBindingType, BufferUsages, ShaderStages};

use svbrdf_core::error::Error;
use svbrdf_core::model::brdf::{Model, Texel};
use svbrdf_shaders as shaders;

use super::Gpu;
use super::fault::scoped;
use super::pipeline::{bind, buffer_type, compute, layout, module, uniform_buffer};
use super::read_back::{read, read_buffer};
use super::uniforms::{ModelUniforms, ProbePoint};

/// Points that one dispatch computes: within every adapter's limits.
const CHUNK: usize = 1 << 18;
/// As in probe.wgsl.
const WORKGROUP: usize = 64;

impl Gpu {
    /// The shader's `render` for every (texel, w_l, w_v) of `inputs`: [`render`](svbrdf_core::model::brdf::render) on the device.
    ///
    /// # Errors
    /// [`Error::Gpu`] where the adapter has no compute shaders or fails.
    pub fn probe(
        &self,
        model: &Model<f32>,
        inputs: &[(Texel<f32>, [f32; 3], [f32; 3])],
    ) -> Result<Vec<[f32; 3]>, Error> {
        let mut radiances = Vec::with_capacity(inputs.len());
        for chunk in inputs.chunks(CHUNK) {
            let points: Vec<ProbePoint> = chunk.iter().map(point).collect();
            let model = ModelUniforms::from(model);
            let buffer = scoped(&self.device, "probing the shader", || dispatch(self, &model, &points))?;
            let bytes = read(self, &buffer)?;
            let values: Vec<[f32; 4]> = bytemuck::pod_collect_to_vec(&bytes);
            radiances.extend(values.into_iter().map(|[r, g, b, _]| [r, g, b]));
        }
        Ok(radiances)
    }
}

fn point((texel, w_l, w_v): &(Texel<f32>, [f32; 3], [f32; 3])) -> ProbePoint {
    ProbePoint {
        normal: texel.normal.to_array(),
        roughness: texel.roughness,
        diffuse: texel.diffuse,
        specular: texel.specular,
        w_l: *w_l,
        w_v: *w_v,
        ..bytemuck::Zeroable::zeroed()
    }
}

/// Computes `points` and copies the results into the buffer that is returned.
fn dispatch(gpu: &Gpu, model: &ModelUniforms, points: &[ProbePoint]) -> wgpu::Buffer {
    let device = &gpu.device;
    let storage = |read_only| buffer_type(BufferBindingType::Storage { read_only });
    let types = [buffer_type(BufferBindingType::Uniform), storage(true), storage(false)];
    let layout = layout(device, ShaderStages::COMPUTE, &types);
    let pipeline = compute(device, &module(device, &shaders::PROBE), "probe", &layout);
    let model = uniform_buffer(device, bytemuck::bytes_of(model));
    let input = device.create_buffer_init(&BufferInitDescriptor {
        label: Some("points"),
        contents: bytemuck::cast_slice(points),
        usage: BufferUsages::STORAGE,
    });
    let output = device.create_buffer(&wgpu::BufferDescriptor {
        label: Some("radiances"),
        size: (points.len() * size_of::<[f32; 4]>()) as u64,
        usage: BufferUsages::STORAGE | BufferUsages::COPY_SRC,
        mapped_at_creation: false,
    });
    let result = read_buffer(gpu, output.size() as usize);
    let resources = [&model, &input, &output].map(wgpu::Buffer::as_entire_binding);
    let group = bind(device, &layout, &resources);

    let mut encoder = device.create_command_encoder(&Default::default());
    let mut pass = encoder.begin_compute_pass(&Default::default());
    pass.set_pipeline(&pipeline);
    pass.set_bind_group(0, &group, &[]);
    pass.dispatch_workgroups(points.len().div_ceil(WORKGROUP) as u32, 1, 1);
    drop(pass);
    encoder.copy_buffer_to_buffer(&output, 0, &result, 0, output.size());
    gpu.queue.submit([encoder.finish()]);
    result
}
