//! The two passes of loss.wgsl, and what they read and write.

use std::ops::Range;

use wgpu::{
    BindGroup, BindGroupLayout, Buffer, BufferBindingType, BufferUsages, ComputePipeline, PollType,
    ShaderStages, SubmissionIndex,
};

use svbrdf_core::error::Error;
use svbrdf_core::material::{Material, Planes};
use svbrdf_core::model::brdf::Model;
use svbrdf_core::model::convention::Convention;
use svbrdf_core::model::grammar::words::Norm;
use svbrdf_core::model::scene::Scene;
use svbrdf_shaders::Shader;

use super::plan::{LANES, PLANES, Plan, blocks};
use crate::Gpu;
use crate::fault::scoped;
use crate::pipeline::{bind, buffer_type, compute, layout, module};
use crate::read_back::{read_after, read_buffer};
use crate::uniforms::{Band, GrammarBand, GrammarScene, LogSum, ModelUniforms, SceneUniforms};

/// The pipelines and what they bind.
#[derive(Debug)]
pub(super) struct Passes {
    /// Sums over the texels of each lane.
    loss: ComputePipeline,
    /// Joins the lanes of each block.
    gather: ComputePipeline,
    layout: BindGroupLayout,
}

impl Passes {
    pub(super) fn new(gpu: &Gpu, shader: &Shader) -> Result<Self, Error> {
        scoped(&gpu.device, "compiling the loss", || {
            let storage = |read_only| buffer_type(BufferBindingType::Storage { read_only });
            let uniform = buffer_type(BufferBindingType::Uniform);
            let types = [uniform, storage(true), storage(true), storage(false), storage(false)];
            let layout = layout(&gpu.device, ShaderStages::COMPUTE, &types);
            let module = module(&gpu.device, shader);
            let [loss, gather] =
                ["loss", "gather"].map(|entry| compute(&gpu.device, &module, entry, &layout));
            Self { loss, gather, layout }
        })
    }

    /// Starts to sum over the band in `buffers`, of `blocks` blocks, for each of `scenes`.
    pub(super) fn submit(
        &self,
        gpu: &Gpu,
        buffers: &Buffers,
        convention: &Convention,
        scenes: &[Scene],
        blocks: usize,
    ) -> Result<Submitted, Error> {
        let sums = scenes.len() * buffers.predictions * blocks;
        let rays: Vec<u8> = scenes.iter().flat_map(|scene| rays(convention, scene, buffers.size)).collect();
        scoped(&gpu.device, "computing a loss", || {
            gpu.queue.write_buffer(&buffers.scenes, 0, &rays);
            let mut encoder = gpu.device.create_command_encoder(&Default::default());
            let mut pass = encoder.begin_compute_pass(&Default::default());
            pass.set_bind_group(0, &buffers.group, &[]);
            pass.set_pipeline(&self.loss);
            pass.dispatch_workgroups(blocks as u32, scenes.len() as u32, 1);
            pass.set_pipeline(&self.gather);
            pass.dispatch_workgroups(sums.div_ceil(LANES) as u32, 1, 1);
            drop(pass);
            let result = read_buffer(gpu, sums * size_of::<LogSum>());
            encoder.copy_buffer_to_buffer(&buffers.block_sums, 0, &result, 0, result.size());
            Submitted { index: gpu.queue.submit([encoder.finish()]), result }
        })
    }
}

/// A step that the device works on.
pub(super) struct Submitted {
    index: SubmissionIndex,
    result: Buffer,
}

impl Submitted {
    /// The sums of the blocks, by scene, prediction and block, once they are there.
    pub(super) fn wait(self, gpu: &Gpu) -> Result<Vec<LogSum>, Error> {
        let ready = PollType::Wait { submission_index: Some(self.index), timeout: None };
        Ok(bytemuck::pod_collect_to_vec(&read_after(gpu, &self.result, ready)?))
    }
}

/// The memory of a job, enough for its largest band and step.
pub(super) struct Buffers {
    band: Buffer,
    scenes: Buffer,
    planes: Buffer,
    block_sums: Buffer,
    group: BindGroup,
    size: [u32; 2],
    predictions: usize,
}

impl Buffers {
    /// For a ground truth and predictions, `materials` in all.
    pub(super) fn new(gpu: &Gpu, passes: &Passes, plan: &Plan, materials: usize) -> Result<Self, Error> {
        let size = counted(gpu, plan.size)?;
        let predictions = materials - 1;
        let sums = plan.scenes_per_step * predictions * plan.blocks() * size_of::<LogSum>();
        scoped(&gpu.device, "taking memory for a loss", || {
            let storage = |bytes: usize, usage| create(gpu, bytes, BufferUsages::STORAGE | usage);
            let uniforms = BufferUsages::UNIFORM | BufferUsages::COPY_DST;
            let band = create(gpu, size_of::<GrammarBand>(), uniforms);
            let scenes = storage(plan.scenes_per_step * size_of::<GrammarScene>(), BufferUsages::COPY_DST);
            let planes = materials * PLANES * plan.texels_per_band * size_of::<f32>();
            let planes = storage(planes, BufferUsages::COPY_DST);
            let lane_sums = storage(sums * LANES, BufferUsages::empty());
            let block_sums = storage(sums, BufferUsages::COPY_SRC);
            let bound = [&band, &scenes, &planes, &lane_sums, &block_sums];
            let group = bind(&gpu.device, &passes.layout, &bound.map(Buffer::as_entire_binding));
            Self { band, scenes, planes, block_sums, group, size, predictions }
        })
    }

    /// Sends `texels` of the materials, the ground truth first.
    pub(super) fn upload(
        &self,
        gpu: &Gpu,
        materials: &[&Material<f32>],
        texels: Range<usize>,
        convention: &Convention,
    ) -> Result<(), Error> {
        let band = Band {
            model: ModelUniforms::from(&Model::from(convention)),
            size: self.size,
            first: texels.start as u32,
            texels: texels.len() as u32,
            stride: texels.len() as u32,
            blocks: blocks(&texels) as u32,
            predictions: self.predictions as u32,
            epsilon: if convention.norm() == Norm::LogL1 { convention.epsilon as f32 } else { 0.0 },
        };
        let band = match convention.member {
            None => bytemuck::bytes_of(&band).to_vec(),
            Some(member) => bytemuck::bytes_of(&GrammarBand::new(band, &member.terms)).to_vec(),
        };
        scoped(&gpu.device, "sending materials", || {
            gpu.queue.write_buffer(&self.band, 0, &band);
            let planes = materials.iter().flat_map(|material| planes(material.planes()));
            for (i, plane) in planes.enumerate() {
                let offset = i * texels.len() * size_of::<f32>();
                let part = bytemuck::cast_slice(&plane[texels.clone()]);
                gpu.queue.write_buffer(&self.planes, offset as u64, part);
            }
        })
    }
}

/// A scene as the shader of the convention reads it.
fn rays(convention: &Convention, scene: &Scene, size: [u32; 2]) -> Vec<u8> {
    match convention.member {
        None => bytemuck::bytes_of(&SceneUniforms::from(scene)).to_vec(),
        Some(member) => {
            let size = size.map(|side| side as usize);
            bytemuck::bytes_of(&GrammarScene::new(&member.terms, scene, size)).to_vec()
        }
    }
}

/// The planes of a material as loss.wgsl reads them.
fn planes(planes: &Planes<f32>) -> [&[f32]; PLANES] {
    let [nx, ny, nz] = &planes.normal;
    let [dr, dg, db] = &planes.diffuse;
    let [sr, sg, sb] = &planes.specular;
    [nx, ny, nz, dr, dg, db, sr, sg, sb, &planes.roughness].map(Vec::as_slice)
}

fn create(gpu: &Gpu, bytes: usize, usage: BufferUsages) -> Buffer {
    gpu.device.create_buffer(&wgpu::BufferDescriptor {
        label: Some("loss"),
        size: bytes as u64,
        usage,
        mapped_at_creation: false,
    })
}

/// `size` where the shader can number the texels.
fn counted(gpu: &Gpu, [width, height]: [usize; 2]) -> Result<[u32; 2], Error> {
    match (u32::try_from(width), u32::try_from(height), u32::try_from(width * height)) {
        (Ok(width), Ok(height), Ok(_)) => Ok([width, height]),
        _ => Err(Error::Gpu {
            problem: format!("{width} x {height} texels are more than {} can number", gpu.report.name),
            remedy: "use a smaller material, or use the CPU",
        }),
    }
}
