//! One JSON object for programs.

use std::io;

use serde::Serialize;
use svbrdf::loss::{Estimate, IntervalSource, Loss, Texels};
use svbrdf::model::sampler::Sampler;
use svbrdf::model::scene::{Kind, Scene};
use svbrdf::report::Report;

use super::printed::Printed;

/// A scene file, too: `--scenes` takes it.
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
    /// In each scene: their number, or "all".
    texels: TexelsEntry,
    /// What all intervals come from.
    interval95_from: IntervalSource,
    target_error: Option<f64>,
    target_reached: Option<bool>,
    /// The losses over all scenes, to +-1%, where no option chooses scenes.
    all_scenes: Option<Vec<PredictionEntry<'a>>>,
    results: Vec<PredictionEntry<'a>>,
    differences: Vec<DifferenceEntry<'a>>,
    /// Left out where a goal decides how many there are, which are far too many to read: their numbers, sampler,
    /// texels and seed ask for the same ones.
    scenes: Option<&'a [Scene]>,
}

#[derive(Serialize)]
#[serde(untagged)]
enum TexelsEntry {
    Number(usize),
    Word(Texels),
}

/// An estimate as JSON.
#[derive(Serialize)]
pub struct EstimateEntry {
    mean: f64,
    standard_error: Option<f64>,
    interval95: Option<[f64; 2]>,
}

impl From<Estimate> for EstimateEntry {
    fn from(e: Estimate) -> Self {
        Self { mean: e.mean, standard_error: e.standard_error, interval95: e.interval95 }
    }
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
    /// That of each scene, in their order.
    losses: Option<&'a [f64]>,
}

pub(super) fn write(printed: &Printed) -> io::Result<String> {
    let report = &printed.report;
    let all = printed.lists_scenes();
    let predictions = report.outcome.losses.iter().enumerate();
    let object = LossJson {
        ground_truth: &report.ground_truth,
        ground_truth_path: printed.ground_truth_path(),
        convention: report.convention.name,
        epsilon: report.convention.epsilon,
        precision: report.precision,
        backend: report.backend,
        size: report.size,
        near: report.count(Kind::Near),
        distant: report.count(Kind::Distant),
        seed: report.seed(),
        sampler: report.sampler(),
        texels: match report.texels() {
            Texels::Sampled(count) => TexelsEntry::Number(count),
            all => TexelsEntry::Word(all),
        },
        interval95_from: report.outcome.interval_source(),
        target_error: printed.target().map(|(error, _)| error),
        target_reached: printed.target().map(|(_, reached)| reached),
        all_scenes: report.all_scenes.as_ref().map(|known| {
            known.losses.iter().enumerate().map(|(index, loss)| entry(printed, index, loss, false)).collect()
        }),
        results: predictions.map(|(index, loss)| entry(printed, index, loss, all)).collect(),
        differences: report.differences().into_iter().map(|d| difference(report, d)).collect(),
        scenes: all.then_some(&report.outcome.scenes),
    };
    Ok(serde_json::to_string_pretty(&object)? + "\n")
}

fn difference<'a>(report: &'a Report, (loss, e): (&'a Loss, Estimate)) -> DifferenceEntry<'a> {
    DifferenceEntry {
        prediction: &loss.prediction,
        to: &report.outcome.losses[0].prediction,
        difference: e.mean,
        standard_error: e.standard_error,
        interval95: e.interval95,
    }
}

fn entry<'a>(printed: &'a Printed, index: usize, loss: &'a Loss, all: bool) -> PredictionEntry<'a> {
    PredictionEntry {
        prediction: &loss.prediction,
        path: printed.prediction_paths().nth(index).flatten(),
        step: printed.step(index),
        loss: loss.estimate.mean,
        standard_error: loss.estimate.standard_error,
        interval95: loss.estimate.interval95,
        losses: all.then_some(&loss.per_scene),
    }
}
