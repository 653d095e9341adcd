//! One JSON object for programs.

use std::io;

use serde::Serialize;
use svbrdf::loss::{Estimate, Loss, Texels};
use svbrdf::report::Report;
use svbrdf::sampler::Sampler;
use svbrdf::scene::{Kind, Scene};

#[derive(Serialize)]
struct Object<'a> {
    convention: &'a str,
    epsilon: f64,
    backend: &'a str,
    size: [usize; 2],
    near: usize,
    distant: usize,
    seed: Option<u64>,
    sampler: Option<Sampler>,
    /// In each scene; absent where all are compared.
    #[serde(skip_serializing_if = "Option::is_none")]
    texels: Option<usize>,
    differences: Vec<DifferenceEntry<'a>>,
    results: Vec<Entry<'a>>,
}

/// How much larger the loss of a prediction is than that of the first, on the same scenes.
#[derive(Serialize)]
struct DifferenceEntry<'a> {
    prediction: &'a str,
    to: &'a str,
    difference: f64,
    standard_error: Option<f64>,
    interval95: Option<[f64; 2]>,
}

#[derive(Serialize)]
struct Entry<'a> {
    prediction: &'a str,
    loss: f64,
    standard_error: Option<f64>,
    interval95: Option<[f64; 2]>,
    scenes: Vec<SceneLoss<'a>>,
}

/// A scene and the loss in it.
#[derive(Serialize)]
struct SceneLoss<'a> {
    #[serde(flatten)]
    scene: &'a Scene,
    loss: f64,
}

pub(super) fn write(report: &Report) -> io::Result<String> {
    let object = Object {
        convention: report.convention.name,
        epsilon: report.convention.epsilon,
        backend: report.backend,
        size: report.size,
        near: report.count(Kind::Near),
        distant: report.count(Kind::Distant),
        seed: report.seed,
        sampler: report.sampler,
        texels: match report.texels {
            Texels::All => None,
            Texels::Sampled(count) => Some(count),
        },
        differences: report.differences().into_iter().map(|d| difference(report, d)).collect(),
        results: report.losses.iter().map(|loss| entry(&report.scenes, loss)).collect(),
    };
    Ok(serde_json::to_string_pretty(&object)? + "\n")
}

fn difference<'a>(report: &'a Report, (loss, e): (&'a Loss, Estimate)) -> DifferenceEntry<'a> {
    DifferenceEntry {
        prediction: &loss.prediction,
        to: &report.losses[0].prediction,
        difference: e.mean,
        standard_error: e.standard_error,
        interval95: e.interval95,
    }
}

fn entry<'a>(scenes: &'a [Scene], loss: &'a Loss) -> Entry<'a> {
    let per_scene = scenes.iter().zip(&loss.per_scene);
    Entry {
        prediction: &loss.prediction,
        loss: loss.estimate.mean,
        standard_error: loss.estimate.standard_error,
        interval95: loss.estimate.interval95,
        scenes: per_scene.map(|(scene, &loss)| SceneLoss { scene, loss }).collect(),
    }
}
