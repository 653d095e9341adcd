//! The JSON of a loss report.

use serde::{Serialize, Serializer};

use super::loss::{FewScenes, LossReport, count, differences};
use super::missed::missed_by_any;
use super::table::Table;
use super::{Report, loss_table};
use crate::error::Error;
use crate::loss::{Estimate, IntervalSource, Loss, Outcome, Texels};
use crate::model::sampler::Sampler;
use crate::model::scene::{Kind, Scene};

/// The top of the JSON. Where it lists scenes, it is a scene file, too, which `--scenes` takes.
#[derive(Serialize)]
struct LossJson<'a> {
    ground_truth: &'a str,
    ground_truth_path: Option<&'a str>,
    convention: &'a str,
    epsilon: f64,
    precision: &'a str,
    backend: &'a str,
    size: [usize; 2],
    near: usize,
    distant: usize,
    seed: Option<u64>,
    sampler: Option<Sampler>,
    texels: TexelsEntry,
    /// The source of all intervals.
    interval95_from: IntervalSource,
    target_error: Option<f64>,
    target_reached: Option<bool>,
    /// The scenes of `few_scenes_loss`, where no option chooses scenes.
    few_scenes: Option<FewScenesEntry<'a>>,
    results: Vec<PredictionEntry<'a>>,
    differences: Vec<DifferenceEntry<'a>>,
    /// Left out where a goal decides how many there are, which are far too many to read: their numbers, sampler,
    /// texels and seed ask for the same ones.
    scenes: Option<&'a [Scene]>,
}

/// The texels in each scene: their number, or "all".
#[derive(Serialize)]
#[serde(untagged)]
enum TexelsEntry {
    Number(usize),
    Word(Texels),
}

/// The settings of the losses over few scenes, and their differences.
#[derive(Serialize)]
struct FewScenesEntry<'a> {
    near: usize,
    distant: usize,
    seed: Option<u64>,
    sampler: Option<Sampler>,
    texels: TexelsEntry,
    backend: &'a str,
    interval95_from: IntervalSource,
    differences: Vec<DifferenceEntry<'a>>,
    scenes: &'a [Scene],
}

/// The loss of a prediction - the loss of the first one, over the same scenes.
#[derive(Serialize)]
struct DifferenceEntry<'a> {
    prediction: &'a str,
    to: &'a str,
    difference: f64,
    standard_error: Option<f64>,
    interval95: Option<[f64; 2]>,
}

#[derive(Serialize)]
struct PredictionEntry<'a> {
    prediction: &'a str,
    path: Option<&'a str>,
    /// Of a training run.
    #[serde(skip_serializing_if = "Option::is_none")]
    step: Option<u64>,
    loss: f64,
    standard_error: Option<f64>,
    interval95: Option<[f64; 2]>,
    /// The loss of each scene, in their order.
    losses: Option<&'a [f64]>,
    #[serde(flatten)]
    few_scenes: Option<FewScenesLoss<'a>>,
}

/// The loss over few scenes beside a more accurate one.
#[derive(Serialize)]
struct FewScenesLoss<'a> {
    few_scenes_loss: f64,
    few_scenes_standard_error: Option<f64>,
    few_scenes_interval95: Option<[f64; 2]>,
    /// The loss of each of the few scenes, in their order.
    few_scenes_losses: &'a [f64],
}

impl Serialize for LossReport {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let results = self.outcome.losses.iter().enumerate();
        let object = LossJson {
            ground_truth: &self.ground_truth,
            ground_truth_path: self.ground_truth_path(),
            convention: self.convention.name,
            epsilon: self.convention.epsilon,
            precision: self.precision,
            backend: self.backend,
            size: self.size,
            near: self.count(Kind::Near),
            distant: self.count(Kind::Distant),
            seed: self.seed(),
            sampler: self.sampler(),
            texels: self.texels().into(),
            interval95_from: self.outcome.interval_source(),
            target_error: self.target_error,
            target_reached: self.target_reached(),
            few_scenes: self.few_scenes.as_ref().map(|few| few_scenes(self, few)),
            results: results.map(|(index, loss)| prediction(self, index, loss)).collect(),
            differences: difference_entries(&self.outcome),
            scenes: self.lists_scenes.then_some(&self.outcome.scenes),
        };
        object.serialize(serializer)
    }
}

impl Report for LossReport {
    fn text(&self) -> String {
        self.text()
    }

    fn table(&self) -> Table {
        loss_table::table(self)
    }

    fn missed(&self) -> Vec<Error> {
        self.target_error.and_then(|target| missed_by_any(target, &self.outcome)).into_iter().collect()
    }
}

impl From<Texels> for TexelsEntry {
    fn from(texels: Texels) -> Self {
        match texels {
            Texels::Sampled(count) => Self::Number(count),
            all => Self::Word(all),
        }
    }
}

fn few_scenes<'a>(report: &LossReport, FewScenes { backend, outcome }: &'a FewScenes) -> FewScenesEntry<'a> {
    FewScenesEntry {
        near: count(outcome, Kind::Near),
        distant: count(outcome, Kind::Distant),
        seed: outcome.sampling.map(|sampling| sampling.seed),
        sampler: outcome.sampling.map(|sampling| sampling.sampler),
        texels: report.texels_of(outcome).into(),
        backend,
        interval95_from: outcome.interval_source(),
        differences: difference_entries(outcome),
        scenes: &outcome.scenes,
    }
}

fn difference_entries<'a>(outcome: &'a Outcome) -> Vec<DifferenceEntry<'a>> {
    let entry = |(loss, e): (&'a Loss, Estimate)| DifferenceEntry {
        prediction: &loss.prediction,
        to: &outcome.losses[0].prediction,
        difference: e.mean,
        standard_error: e.standard_error,
        interval95: e.interval95,
    };
    differences(outcome).into_iter().map(entry).collect()
}

fn prediction<'a>(report: &'a LossReport, index: usize, loss: &'a Loss) -> PredictionEntry<'a> {
    let few = report.few_scenes_loss(index).map(|few| FewScenesLoss {
        few_scenes_loss: few.estimate.mean,
        few_scenes_standard_error: few.estimate.standard_error,
        few_scenes_interval95: few.estimate.interval95,
        few_scenes_losses: &few.per_scene,
    });
    PredictionEntry {
        prediction: &loss.prediction,
        path: report.prediction_path(index),
        step: report.step(index),
        loss: loss.estimate.mean,
        standard_error: loss.estimate.standard_error,
        interval95: loss.estimate.interval95,
        losses: report.lists_scenes.then_some(&loss.per_scene),
        few_scenes: few,
    }
}
