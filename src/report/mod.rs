//! Losses with everything that gives them a meaning: what the command line prints and the window copies.

mod names;
mod text;

pub use names::told_apart;

use crate::loss::{Comparison, Compute, Estimate, Loss, Outcome, Texels};
use crate::model::convention::Convention;
use crate::model::sampler::Sampler;
use crate::model::scene::Kind;

/// Losses with everything that gives them a meaning.
#[derive(Clone, Debug)]
pub struct Report {
    pub convention: Convention,
    /// The name of the ground truth.
    pub ground_truth: String,
    /// Width and height in texels.
    pub size: [usize; 2],
    /// `f32` or `f64`.
    pub precision: &'static str,
    /// What computed it: `cpu` or `gpu`.
    pub backend: &'static str,
    pub outcome: Outcome,
}

impl Report {
    /// The report of what `comparison` gave.
    pub fn new<T: Compute>(comparison: &Comparison<'_, T>, outcome: Outcome) -> Self {
        Self {
            convention: *comparison.convention(),
            ground_truth: comparison.ground_truth().name().to_owned(),
            size: comparison.ground_truth().size(),
            precision: T::NAME,
            backend: comparison.backend().name(),
            outcome,
        }
    }

    /// The same report with other names: that of the ground truth first, then one per prediction.
    #[must_use]
    pub fn renamed(mut self, names: &[String]) -> Self {
        let Some((ground_truth, predictions)) = names.split_first() else { return self };
        self.ground_truth.clone_from(ground_truth);
        for (loss, name) in self.outcome.losses.iter_mut().zip(predictions) {
            loss.prediction.clone_from(name);
        }
        self
    }

    /// How much larger each further loss is than the first, on the same scenes.
    pub fn differences(&self) -> Vec<(&Loss, Estimate)> {
        let Some((first, others)) = self.outcome.losses.split_first() else { return Vec::new() };
        others.iter().map(|loss| (loss, self.outcome.difference(loss, first))).collect()
    }

    /// The seed that names the scenes; `None` where they were listed.
    pub fn seed(&self) -> Option<u64> {
        self.outcome.sampling.map(|sampling| sampling.seed)
    }

    /// How the scenes were sampled; `None` where they were listed.
    pub fn sampler(&self) -> Option<Sampler> {
        self.outcome.sampling.map(|sampling| sampling.sampler)
    }

    /// The texels that are compared in each scene.
    pub fn texels(&self) -> Texels {
        let sampled = self.outcome.sampling.and_then(|sampling| sampling.texels.sampled(self.size));
        sampled.map_or(Texels::All, Texels::Sampled)
    }

    /// The number of scenes of a kind.
    pub fn count(&self, kind: Kind) -> usize {
        self.outcome.scenes.iter().filter(|scene| scene.kind == kind).count()
    }
}
