//! Losses with the settings that they depend on.

use crate::error::Error;
use crate::loss::{Comparison, Compute, Estimate, Loss, Outcome, Question, Request, Texels};
use crate::model::convention::Convention;
use crate::model::sampler::Sampler;
use crate::model::scene::Kind;
use crate::progress::Progress;

/// The losses of predictions, and what they depend on.
#[derive(Clone, Debug)]
pub struct LossReport {
    /// The convention that the losses follow.
    pub convention: Convention,
    /// The name of the ground truth.
    pub ground_truth: String,
    /// Width and height in texels.
    pub size: [usize; 2],
    /// `f32` or `f64`.
    pub precision: &'static str,
    /// What computed the losses: `cpu` or `gpu`.
    pub backend: &'static str,
    /// The scenes and the losses.
    pub outcome: Outcome,
    /// The requested accuracy: half of the 95% interval, as a share of the loss.
    pub target_error: Option<f64>,
    /// Whether the request names the number of scenes, so that a list of them has a readable length.
    pub lists_scenes: bool,
    /// The losses over the few scenes of the papers, where they stand beside a more accurate loss.
    pub few_scenes: Option<FewScenes>,
    /// Where the ground truth and then the predictions were read from; empty, or `None` for others.
    pub paths: Vec<Option<String>>,
    /// The step of the training run that each prediction is; empty, or `None` for others.
    pub steps: Vec<Option<u64>>,
}

/// Losses over the few scenes of the papers: another estimate of the loss, which depends on the seed.
#[derive(Clone, Debug)]
pub struct FewScenes {
    /// What computed them: `cpu` or `gpu`.
    pub backend: &'static str,
    /// The scenes and the losses.
    pub outcome: Outcome,
}

impl LossReport {
    /// The report of the `outcome` of `request` to `comparison`.
    pub fn new<T: Compute>(comparison: &Comparison<'_, T>, request: &Request, outcome: Outcome) -> Self {
        let target_error = match *request {
            Request::Accuracy { target, .. } => Some(target),
            _ => None,
        };
        Self {
            convention: *comparison.convention(),
            ground_truth: comparison.ground_truth().name().to_owned(),
            size: comparison.ground_truth().size(),
            precision: T::NAME,
            backend: comparison.backend().name(),
            outcome,
            target_error,
            lists_scenes: matches!(request, Request::Scenes(_) | Request::Listed(_)),
            few_scenes: None,
            paths: Vec::new(),
            steps: Vec::new(),
        }
    }

    /// The answer of `comparison` to `question`. An accuracy and a time are computed on the CPU.
    ///
    /// # Errors
    /// As [`Comparison::run`].
    pub fn answer<T: Compute>(
        comparison: &Comparison<'_, T>,
        question: &Question,
        progress: &Progress,
    ) -> Result<Self, Error> {
        let report = Self::new(comparison, &question.request, comparison.run(&question.request, progress)?);
        let Some(few) = question.few_scenes else { return Ok(report) };
        let few = Request::Scenes(few);
        Ok(report.beside(Self::new(comparison, &few, comparison.run(&few, progress)?)))
    }

    /// The same report with the losses over the few scenes of the papers beside it.
    #[must_use]
    pub fn beside(self, few: Self) -> Self {
        let few_scenes = Some(FewScenes { backend: few.backend, outcome: few.outcome });
        Self { few_scenes, ..self }
    }

    /// The same report with other names: the ground truth first, then each prediction.
    #[must_use]
    pub fn renamed(mut self, names: &[String]) -> Self {
        let Some((ground_truth, predictions)) = names.split_first() else { return self };
        self.ground_truth.clone_from(ground_truth);
        let few = self.few_scenes.as_mut().map(|few| &mut few.outcome);
        for outcome in [&mut self.outcome].into_iter().chain(few) {
            for (loss, name) in outcome.losses.iter_mut().zip(predictions) {
                loss.prediction.clone_from(name);
            }
        }
        self
    }

    /// Whether the requested accuracy is reached by every loss; `None` where none was requested.
    pub fn target_reached(&self) -> Option<bool> {
        self.target_error.map(|target| self.outcome.relative_error95() <= target)
    }

    /// The paired difference of each further loss from the first: `loss - first`, over the same scenes.
    pub fn differences(&self) -> Vec<(&Loss, Estimate)> {
        differences(&self.outcome)
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
        self.texels_of(&self.outcome)
    }

    /// The number of scenes of a kind.
    pub fn count(&self, kind: Kind) -> usize {
        count(&self.outcome, kind)
    }

    /// The texels that `outcome` compares in each scene.
    pub(super) fn texels_of(&self, outcome: &Outcome) -> Texels {
        let sampled = outcome.sampling.and_then(|sampling| sampling.texels.sampled(self.size));
        sampled.map_or(Texels::All, Texels::Sampled)
    }

    /// The loss of the prediction with this index over the few scenes of the papers.
    pub(super) fn few_scenes_loss(&self, index: usize) -> Option<&Loss> {
        self.few_scenes.as_ref()?.outcome.losses.get(index)
    }

    /// Where the ground truth was read from.
    pub(super) fn ground_truth_path(&self) -> Option<&str> {
        self.paths.first()?.as_deref()
    }

    /// Where the prediction with this index was read from.
    pub(super) fn prediction_path(&self, index: usize) -> Option<&str> {
        self.paths.get(index + 1)?.as_deref()
    }

    /// The step of the training run that the prediction with this index is.
    pub(super) fn step(&self, index: usize) -> Option<u64> {
        self.steps.get(index).copied().flatten()
    }
}

/// The paired difference of each further loss from the first, over the same scenes.
pub(super) fn differences(outcome: &Outcome) -> Vec<(&Loss, Estimate)> {
    let others = outcome.losses.iter().enumerate().skip(1);
    others.map(|(index, loss)| (loss, outcome.difference(index, 0))).collect()
}

/// The number of scenes of a kind.
pub(super) fn count(outcome: &Outcome, kind: Kind) -> usize {
    outcome.scenes.iter().filter(|scene| scene.kind == kind).count()
}
