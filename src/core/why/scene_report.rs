//! The scenes of a loss as JSON, which is a scene file, too.

use serde::Serialize;

use super::scene_losses::RankedScene;
use crate::loss::{Loss, Outcome};
use crate::model::convention::Convention;
use crate::model::scene::Scene;

/// What is written of the scenes of a loss: what was compared, and the losses in each scene.
#[derive(Debug, Serialize)]
pub struct SceneReport<'a> {
    ground_truth: &'a str,
    convention: &'a str,
    epsilon: f64,
    seed: Option<u64>,
    /// The number of scenes that these are the worst of.
    of: usize,
    results: Vec<ScenesEntry<'a>>,
    scenes: Vec<Scene>,
}

#[derive(Debug, Serialize)]
struct ScenesEntry<'a> {
    prediction: &'a str,
    /// Over all scenes.
    loss: f64,
    /// That of each listed scene.
    losses: Vec<f64>,
}

impl<'a> SceneReport<'a> {
    /// The report of `ranked`, which are scenes of `outcome`.
    pub fn new(
        ground_truth: &'a str,
        convention: &'a Convention,
        outcome: &'a Outcome,
        ranked: &[RankedScene],
    ) -> Self {
        let entry = |(index, loss): (usize, &'a Loss)| ScenesEntry {
            prediction: &loss.prediction,
            loss: loss.estimate.mean,
            losses: ranked.iter().map(|ranked| ranked.losses[index]).collect(),
        };
        Self {
            ground_truth,
            convention: convention.name,
            epsilon: convention.epsilon,
            seed: outcome.sampling.map(|sampling| sampling.seed),
            of: outcome.scenes.len(),
            results: outcome.losses.iter().enumerate().map(entry).collect(),
            scenes: ranked.iter().map(|ranked| ranked.scene).collect(),
        }
    }
}
