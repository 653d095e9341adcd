//! The losses of all predictions of all materials.

use std::collections::BTreeMap;
use std::path::Path;

use rayon::prelude::*;

use super::record::{Candidate, Case, KnownLoss, MaterialResult, PredictionResult, RunSettings};
use crate::error::Error;
use crate::loss::{Comparison, Request, check_same_size};
use crate::material::Material;
use crate::metrics::of_maps;
use crate::model::convention::Convention;
use crate::progress::Progress;
use crate::rank::most_scenes;

/// What is read: a ground truth or a prediction.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    GroundTruth,
    Prediction,
}

/// Computes the losses of `tasks`, in parallel; `done` sees each result as soon as it is there, in any order.
///
/// All predictions of a material are compared in the same scenes, as many as the target error of every one needs, at
/// most [`most_scenes`]. What cannot be read or
/// compared is a result, too: it says why. A material is one step of `progress`. The results do not depend on the number
/// of threads, nor on which other materials there are.
///
/// # Errors
/// [`Error::Cancelled`], and those of `done`.
pub(super) fn evaluate(
    tasks: &[Case],
    settings: &RunSettings,
    convention: &Convention,
    read: impl Fn(&Path, Side) -> Result<Material<f32>, Error> + Sync,
    progress: &Progress,
    done: impl Fn(&MaterialResult) -> Result<(), Error> + Sync,
) -> Result<(), Error> {
    progress.begin(tasks.len() as u64);
    tasks.par_iter().try_for_each(|task| {
        done(&one(task, settings, convention, &read, progress)?)?;
        progress.step()
    })
}

fn one(
    task: &Case,
    settings: &RunSettings,
    convention: &Convention,
    read: &impl Fn(&Path, Side) -> Result<Material<f32>, Error>,
    progress: &Progress,
) -> Result<MaterialResult, Error> {
    let seed = seed_of(settings.seed, task.index);
    let truth = read(&task.ground_truth, Side::GroundTruth);
    let mut results: Vec<Result<Material<f32>, Error>> = Vec::new();
    for candidate in &task.candidates {
        results.push(match &truth {
            Ok(truth) => read(&candidate.path, Side::Prediction)
                .and_then(|prediction| check_same_size(truth, &prediction).map(|()| prediction)),
            Err(problem) => Err(Error::Internal(problem.to_string())),
        });
    }
    let readable: Vec<&Material<f32>> = results.iter().flatten().collect();
    let outcome = match &truth {
        Ok(truth) if !readable.is_empty() => {
            let request = Request::Accuracy { target: settings.target_error, seed };
            let comparison = Comparison::new(truth, &readable, *convention)?;
            Some(comparison.at_most(most_scenes(readable.len())).run(&request, &progress.part())?)
        }
        _ => None,
    };
    let mut losses = outcome.iter().flat_map(|outcome| &outcome.losses);
    let refusal = truth.as_ref().err().map(|problem| format!("ground truth: {problem}"));
    let measured = |read: &Result<Material<f32>, Error>| match (&truth, read) {
        (Ok(truth), Ok(prediction)) if settings.metrics => metrics(truth, prediction),
        _ => BTreeMap::new(),
    };
    let prediction = |(candidate, read): (&Candidate, &Result<_, Error>)| {
        let known = match (read, &refusal) {
            (_, Some(refusal)) => Err(refusal.clone()),
            (Err(problem), None) => Err(problem.to_string()),
            (Ok(_), None) => {
                losses.next().map(|loss| known(&loss.estimate)).ok_or_else(|| "no loss".to_owned())
            }
        };
        let Candidate { method, sample, path } = candidate;
        let path = path.display().to_string();
        PredictionResult {
            method: method.clone(),
            sample: *sample,
            path,
            result: known,
            metrics: measured(read),
        }
    };
    let predictions = task.candidates.iter().zip(&results).map(prediction).collect();
    let scenes = outcome.as_ref().map_or(0, |outcome| outcome.scenes.len());
    Ok(MaterialResult { index: task.index, material: task.material.clone(), seed, scenes, predictions })
}

/// The metrics of the maps of materials of one size.
fn metrics(truth: &Material<f32>, prediction: &Material<f32>) -> BTreeMap<String, f64> {
    let metrics = of_maps(truth, prediction).unwrap_or_default();
    metrics.into_iter().map(|metric| (metric.name.to_owned(), metric.value)).collect()
}

fn known(estimate: &crate::loss::Estimate) -> KnownLoss {
    KnownLoss {
        loss: estimate.mean,
        standard_error: estimate.standard_error.unwrap_or(0.0),
        interval95: estimate.interval95.unwrap_or([estimate.mean; 2]),
    }
}

/// The seed of the scenes of a material.
fn seed_of(seed: u64, index: usize) -> u64 {
    /// Odd: the fractional part of the root of 5, times 2^64.
    const STEP: u64 = 0x3c6e_f372_fe94_f82b;
    seed.wrapping_add(STEP.wrapping_mul(index as u64))
}
