//! Algorithm 1 on the device: a backend of [`Comparison`].
//!
//! The maps are sent in bands of texels ([`plan`]), so that no material is too large and memory is bounded. For each
//! band and some scenes at a time, the device sums over blocks of texels ([`pass`]), and the blocks are added here in
//! their order: how a job is cut changes no bit.

mod pass;
mod plan;

use std::sync::OnceLock;

use svbrdf_core::error::Error;
use svbrdf_core::loss::{Backend, Comparison};
use svbrdf_core::material::Material;
use svbrdf_core::model::convention::Convention;
use svbrdf_core::model::grammar::words::Norm;
use svbrdf_core::model::scene::Scene;
use svbrdf_core::progress::Progress;
use svbrdf_shaders as shaders;

use super::Gpu;
use super::fault::failed;
use super::uniforms::LogSum;

use pass::{Buffers, Passes};
use plan::{MOST_PREDICTIONS, Plan};

/// The loss on a graphics adapter. Worth keeping: a driver compiles its pipelines for some time.
///
/// On one device, the same bits every time; a relative 1e-5 from f64 at most.
#[derive(Debug)]
pub struct GpuLosses {
    gpu: Gpu,
    passes: Passes,
    /// Of the renderers of the grammar of conventions: log differences, and squares.
    grammar: [OnceLock<Passes>; 2],
}

impl GpuLosses {
    /// Compiles the shader.
    ///
    /// # Errors
    /// [`Error::Gpu`] where the adapter has no compute shaders or refuses.
    pub fn new(gpu: &Gpu) -> Result<Self, Error> {
        Ok(Self { gpu: gpu.clone(), passes: Passes::new(gpu, &shaders::LOSS)?, grammar: Default::default() })
    }

    /// The passes of a convention, compiled when they are needed.
    fn passes(&self, convention: &Convention) -> Result<&Passes, Error> {
        if convention.member.is_none() {
            return Ok(&self.passes);
        }
        let (kept, shader) = match convention.norm() {
            Norm::LogL1 => (&self.grammar[0], &shaders::GRAMMAR_LOSS),
            Norm::Mse => (&self.grammar[1], &shaders::GRAMMAR_SQUARES),
            _ => return Err(Error::not_by("a graphics adapter", convention.name)),
        };
        if let Some(passes) = kept.get() {
            return Ok(passes);
        }
        let passes = Passes::new(&self.gpu, shader)?;
        Ok(kept.get_or_init(|| passes))
    }

    /// The name of the adapter.
    pub fn adapter(&self) -> &str {
        &self.gpu.report.name
    }
}

impl Backend<f32> for GpuLosses {
    fn name(&self) -> &'static str {
        "gpu"
    }

    fn scene_losses(
        &self,
        comparison: &Comparison<'_, f32>,
        scenes: &[Scene],
        texels: Option<&[usize]>,
        progress: &Progress,
    ) -> Result<Vec<Vec<f64>>, Error> {
        let convention = comparison.convention();
        let passes = self.passes(convention)?;
        if texels.is_some() || comparison.places().1.is_some() {
            let problem = "it compares all texels, and a part of them was asked for".to_owned();
            return Err(Error::Gpu { problem, remedy: "compute this loss on the processor" });
        }
        let (gpu, ground_truth) = (&self.gpu, comparison.ground_truth());
        let limit = gpu.device.limits().max_storage_buffer_binding_size;
        let plan = |group: &[_]| Plan::new(limit, ground_truth.size(), scenes.len(), group.len());
        let groups: Vec<_> =
            comparison.predictions().chunks(MOST_PREDICTIONS).map(|g| (g, plan(g))).collect();
        progress.begin(groups.iter().map(|(_, plan)| plan.steps()).sum());
        let count = 3.0 * (ground_truth.width() * ground_truth.height()) as f64;
        let mut losses = Vec::with_capacity(comparison.predictions().len());
        for (group, plan) in groups {
            let group_loss = GroupLoss { gpu, passes, plan, convention, scenes };
            let materials: Vec<_> = [ground_truth].iter().chain(group).copied().collect();
            let sums = group_loss.run(&materials, progress)?;
            losses.extend(sums.into_iter().map(|sums| sums.into_iter().map(|sum| sum / count).collect()));
        }
        if losses.iter().flatten().any(|loss: &f64| !loss.is_finite()) {
            return Err(failed("it computed a loss that is not a number".to_owned()));
        }
        Ok(losses)
    }
}

/// The losses of a group: as many predictions as one pass takes.
struct GroupLoss<'a> {
    gpu: &'a Gpu,
    passes: &'a Passes,
    plan: Plan,
    convention: &'a Convention,
    scenes: &'a [Scene],
}

impl GroupLoss<'_> {
    /// For each prediction the sum over texels and channels of each scene.
    fn run(&self, materials: &[&Material<f32>], progress: &Progress) -> Result<Vec<Vec<f64>>, Error> {
        let buffers = Buffers::new(self.gpu, self.passes, &self.plan, materials.len())?;
        let norm = self.convention.norm();
        let mut sums = vec![vec![0.0; self.scenes.len()]; materials.len() - 1];
        // The device works on one step while the sums of the step before are added.
        let mut under_way = None;
        for texels in self.plan.bands() {
            buffers.upload(self.gpu, materials, texels.clone(), self.convention)?;
            for scenes in self.plan.scenes() {
                let blocks = plan::blocks(&texels);
                let submitted = self.passes.submit(
                    self.gpu,
                    &buffers,
                    self.convention,
                    &self.scenes[scenes.clone()],
                    blocks,
                )?;
                if let Some((scenes, blocks, earlier)) = under_way.replace((scenes, blocks, submitted)) {
                    add(&mut sums, scenes, blocks, norm, &earlier.wait(self.gpu)?);
                    progress.step()?;
                }
            }
        }
        if let Some((scenes, blocks, last)) = under_way {
            add(&mut sums, scenes, blocks, norm, &last.wait(self.gpu)?);
            progress.step()?;
        }
        Ok(sums)
    }
}

/// Adds the sums of blocks, which lie by scene, prediction and block, to the sums of the predictions.
fn add(
    sums: &mut [Vec<f64>],
    scenes: std::ops::Range<usize>,
    blocks: usize,
    norm: Norm,
    of_blocks: &[LogSum],
) {
    let predictions = sums.len();
    for (scene, of_scene) in scenes.zip(of_blocks.chunks(predictions * blocks)) {
        for (sums, blocks) in sums.iter_mut().zip(of_scene.chunks(blocks)) {
            for block in blocks {
                sums[scene] += block.total(norm);
            }
        }
    }
}
