//! Losses with everything that gives them a meaning: what the command line prints and the window copies.

mod names;
mod text;

pub use names::distinct_names;

use crate::loss::{Estimate, Loss, Texels};
use crate::model::convention::Convention;
use crate::model::sampler::Sampler;
use crate::model::scene::{Kind, Scene};

/// Losses with everything that gives them a meaning.
#[derive(Clone, Debug)]
pub struct Report {
    pub convention: Convention,
    /// The name of the ground truth.
    pub ground_truth: String,
    /// Width and height in texels.
    pub size: [usize; 2],
    /// `None` where the scenes come from a file.
    pub seed: Option<u64>,
    /// `None` where the scenes come from a file.
    pub sampler: Option<Sampler>,
    pub texels: Texels,
    pub precision: &'static str,
    /// What computed it: cpu or gpu.
    pub backend: &'static str,
    pub scenes: Vec<Scene>,
    pub losses: Vec<Loss>,
}

impl Report {
    /// How much larger each further loss is than the first, on the same scenes.
    pub fn differences(&self) -> Vec<(&Loss, Estimate)> {
        let Some((first, others)) = self.losses.split_first() else { return Vec::new() };
        others.iter().map(|loss| (loss, self.difference(loss, first))).collect()
    }

    /// How much larger one loss of this report is than another: negative where it is closer to the ground truth.
    pub fn difference(&self, loss: &Loss, less: &Loss) -> Estimate {
        let sampler = self.sampler.unwrap_or_default();
        Estimate::of_difference(sampler, &self.scenes, &loss.per_scene, &less.per_scene)
    }

    /// The texels that are compared in each scene: all where no fewer were asked for.
    pub fn compared(&self) -> Texels {
        match self.texels {
            Texels::Sampled(count) if count < self.size[0] * self.size[1] => self.texels,
            _ => Texels::All,
        }
    }

    /// The number of scenes of a kind.
    pub fn count(&self, kind: Kind) -> usize {
        self.scenes.iter().filter(|scene| scene.kind == kind).count()
    }
}
