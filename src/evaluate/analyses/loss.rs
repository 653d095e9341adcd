//! Losses with the settings that they depend on: the JSON.

use serde::{Serialize, Serializer};

use svbrdf_core::error::Error;
use svbrdf_core::loss::{Comparison, Compute, Estimate, IntervalSource, Loss, Outcome, Request};
use svbrdf_core::model::sampler::Sampler;
use svbrdf_core::model::scene::{Kind, Scene};
use svbrdf_core::progress::Progress;

/// Losses with the settings that they depend on. Where the JSON lists scenes, it is a scene file, too, which `--scenes` takes.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct LossReport {
    /// The name of the ground truth.
    pub ground_truth: String,
    /// Where it was read from.
    pub(super) ground_truth_path: Option<String>,
    /// The name of the convention.
    pub convention: &'static str,
    pub epsilon: f64,
    /// `f32` or `f64`.
    pub precision: &'static str,
    /// Width and height in texels.
    pub size: [usize; 2],
    /// How many texels the mask keeps; `None` without one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub masked: Option<usize>,
    /// Where the convention renders normals as stored, and their lengths differ from 1: that losses are of normalized ones.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub note: Option<String>,
    #[serde(flatten)]
    pub sampled: SampledScenes,
    /// The source of all intervals.
    pub(super) interval95_from: IntervalSource,
    /// The requested accuracy: half of the 95% interval, as a share of the loss.
    pub(super) target_error: Option<f64>,
    /// Whether every loss has the requested accuracy; `None` where none was requested.
    pub(super) target_reached: Option<bool>,
    /// The scenes of `few_scenes_loss` of the results; `None` where an option chooses scenes.
    pub(super) few_scenes: Option<FewScenes>,
    /// One per prediction, in their order.
    pub(super) results: Vec<PredictionLoss>,
    /// One per prediction but the first.
    pub(super) differences: Vec<LossDifference>,
    /// `None` where a goal decides how many there are, which are far too many to read: their numbers, sampler, texels and seed ask for
    /// the same ones.
    scenes: Option<Vec<Scene>>,
    /// The scenes and the losses.
    #[serde(skip)]
    pub outcome: Outcome,
}

/// How many scenes there are, and how they were sampled.
#[derive(Clone, Copy, Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct SampledScenes {
    /// The number of near-field scenes.
    pub near: usize,
    /// The number of distant scenes.
    pub distant: usize,
    /// The seed that names the scenes; `None` where they were listed.
    pub seed: Option<u64>,
    /// `None` where the scenes were listed.
    pub sampler: Option<Sampler>,
    /// The number of random texels in each scene, or "all".
    #[serde(serialize_with = "count_or_all")]
    #[cfg_attr(feature = "schema", schemars(schema_with = "number_or_all"))]
    pub(super) texels: Option<usize>,
}

fn count_or_all<S: Serializer>(texels: &Option<usize>, serializer: S) -> Result<S::Ok, S::Error> {
    match texels {
        Some(count) => count.serialize(serializer),
        None => "all".serialize(serializer),
    }
}

#[cfg(feature = "schema")]
fn number_or_all(_: &mut schemars::SchemaGenerator) -> schemars::Schema {
    schemars::json_schema!({"anyOf": [{"type": "integer"}, {"const": "all"}]})
}

/// The scenes of the losses over few scenes: another estimate of the loss, which depends on the seed.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub(super) struct FewScenes {
    #[serde(flatten)]
    pub sampled: SampledScenes,
    interval95_from: IntervalSource,
    /// One per prediction but the first, in these scenes.
    differences: Vec<LossDifference>,
    scenes: Vec<Scene>,
}

/// The loss of a prediction - the loss of the first one, over the same scenes.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub(super) struct LossDifference {
    pub prediction: String,
    /// The name of the first prediction.
    pub to: String,
    difference: f64,
    standard_error: Option<f64>,
    interval95: Option<[f64; 2]>,
}

/// The loss of one prediction: the mean over scenes, texels and RGB of |ln(R_gt + epsilon) - ln(R_pred + epsilon)|.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "schema", schemars(rename = "Loss"))]
pub(super) struct PredictionLoss {
    pub prediction: String,
    /// Where it was read from.
    pub path: Option<String>,
    pub loss: f64,
    /// Due to the sampling of scenes and texels; `None` where a kind has a single scene.
    pub standard_error: Option<f64>,
    /// The 95% confidence interval of the loss over all scenes.
    pub interval95: Option<[f64; 2]>,
    /// The loss of each scene, in their order; `None` where an accuracy or a time decided how many there are.
    losses: Option<Vec<f64>>,
    #[serde(flatten)]
    pub few_scenes: Option<FewScenesLoss>,
}

/// The loss over few scenes beside a more accurate one.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub(super) struct FewScenesLoss {
    /// The loss over the 6 + 3 random scenes of the papers, beside a loss over all scenes.
    pub few_scenes_loss: f64,
    few_scenes_standard_error: Option<f64>,
    pub few_scenes_interval95: Option<[f64; 2]>,
    /// The loss of each of the few scenes, in their order.
    few_scenes_losses: Vec<f64>,
}

impl LossReport {
    /// The report of the `outcome` of `request` to `comparison`.
    pub fn new<T: Compute>(comparison: &Comparison<'_, T>, request: &Request, outcome: Outcome) -> Self {
        let target_error = request.target();
        // Their number was requested, so that a list of them has a readable length.
        let lists_scenes = matches!(request, Request::Scenes(_) | Request::Listed(_));
        let (convention, size) = (comparison.convention(), comparison.ground_truth().size());
        Self {
            ground_truth: comparison.ground_truth().name().to_owned(),
            ground_truth_path: None,
            convention: convention.name,
            epsilon: convention.epsilon,
            precision: T::NAME,
            size,
            masked: None,
            note: None,
            sampled: SampledScenes::of(&outcome, size),
            interval95_from: outcome.interval_source(),
            target_error,
            target_reached: target_error.map(|target| outcome.relative_error95() <= target),
            few_scenes: None,
            results: outcome.losses.iter().map(|loss| PredictionLoss::of(loss, lists_scenes)).collect(),
            differences: (1..outcome.losses.len()).map(|index| LossDifference::of(&outcome, index)).collect(),
            scenes: lists_scenes.then(|| outcome.scenes.clone()),
            outcome,
        }
    }

    /// The answer of `comparison` to `request`; `with_few_scenes` has the losses over the few scenes of the papers beside it.
    ///
    /// # Errors
    /// As [`Comparison::run`].
    pub fn answer<T: Compute>(
        comparison: &Comparison<'_, T>,
        request: &Request,
        with_few_scenes: bool,
        progress: &Progress,
    ) -> Result<Self, Error> {
        let report = Self::new(comparison, request, comparison.run(request, progress)?);
        if !with_few_scenes {
            return Ok(report);
        }
        let few = Request::default().of_seed(request.seed().unwrap_or(0));
        Ok(report.beside(Self::new(comparison, &few, comparison.run(&few, progress)?)))
    }

    /// The same report with the losses over few scenes beside it.
    fn beside(mut self, few: Self) -> Self {
        for (result, few) in self.results.iter_mut().zip(few.results) {
            result.few_scenes = Some(FewScenesLoss {
                few_scenes_loss: few.loss,
                few_scenes_standard_error: few.standard_error,
                few_scenes_interval95: few.interval95,
                few_scenes_losses: few.losses.unwrap_or_default(),
            });
        }
        let Self { sampled, interval95_from, differences, outcome, .. } = few;
        let scenes = outcome.scenes;
        let few_scenes = Some(FewScenes { sampled, interval95_from, differences, scenes });
        Self { few_scenes, ..self }
    }

    /// The same report of materials that were read from `paths`, the ground truth first.
    pub(super) fn read_from(mut self, paths: &[Option<String>]) -> Self {
        let mut paths = paths.iter().cloned();
        self.ground_truth_path = paths.next().flatten();
        for (result, path) in self.results.iter_mut().zip(paths) {
            result.path = path;
        }
        self
    }
}

impl SampledScenes {
    fn of(outcome: &Outcome, size: [usize; 2]) -> Self {
        let count = |kind| outcome.scenes.iter().filter(|scene| scene.kind == kind).count();
        Self {
            near: count(Kind::Near),
            distant: count(Kind::Distant),
            seed: outcome.sampling.map(|sampling| sampling.seed),
            sampler: outcome.sampling.map(|sampling| sampling.sampler),
            texels: outcome.sampling.and_then(|sampling| sampling.texels.sampled(size)),
        }
    }
}

impl PredictionLoss {
    fn of(loss: &Loss, lists_scenes: bool) -> Self {
        let Loss { prediction, estimate, per_scene } = loss;
        Self {
            prediction: prediction.clone(),
            path: None,
            loss: estimate.mean,
            standard_error: estimate.standard_error,
            interval95: estimate.interval95,
            losses: lists_scenes.then(|| per_scene.clone()),
            few_scenes: None,
        }
    }

    pub fn estimate(&self) -> Estimate {
        Estimate { mean: self.loss, standard_error: self.standard_error, interval95: self.interval95 }
    }
}

impl LossDifference {
    /// Of the prediction with this index.
    fn of(outcome: &Outcome, index: usize) -> Self {
        let Estimate { mean, standard_error, interval95 } = outcome.difference(index, 0);
        let [prediction, to] = [index, 0].map(|index| outcome.losses[index].prediction.clone());
        Self { prediction, to, difference: mean, standard_error, interval95 }
    }

    pub fn estimate(&self) -> Estimate {
        Estimate { mean: self.difference, standard_error: self.standard_error, interval95: self.interval95 }
    }
}
