//! What a person asks of the loss: a number of scenes, an accuracy or a time.

use std::time::Duration;

use serde::{Deserialize, Serialize};

use crate::error::Error;
use crate::loss::adaptive::{self, Goal, Reached};
use crate::loss::prefix;
use crate::loss::{LossParams, Texels, losses_of_f32};
use crate::material::Material;
use crate::model::convention::Convention;
use crate::model::sampler::Sampler;
use crate::progress::Progress;

/// What decides how many scenes there are.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Ask {
    #[default]
    Scenes,
    Accuracy,
    Time,
}

/// The fields of the loss section. Those that the other two ways of asking need are kept.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct LossSettings {
    pub ask: Ask,
    pub near: usize,
    pub distant: usize,
    pub sampler: Sampler,
    pub texels: Texels,
    pub seed: u64,
    /// Half of the 95% interval, in percent of the loss.
    pub target_percent: f64,
    pub time_ms: u64,
}

impl Default for LossSettings {
    fn default() -> Self {
        let LossParams { near, distant, sampler, texels, seed, .. } = LossParams::default();
        Self { ask: Ask::Scenes, near, distant, sampler, texels, seed, target_percent: 1.0, time_ms: 100 }
    }
}

impl LossSettings {
    /// What is asked for; fields that are not shown do not influence it.
    pub fn request(&self, convention: Convention) -> LossRequest {
        let params = LossParams { seed: self.seed, convention, ..LossParams::default() };
        match self.ask {
            Ask::Scenes => {
                let Self { near, distant, sampler, texels, .. } = *self;
                LossRequest { params: LossParams { near, distant, sampler, texels, ..params }, goal: None }
            }
            Ask::Accuracy => {
                LossRequest { params, goal: Some(Goal::RelativeError(self.target_percent / 100.0)) }
            }
            Ask::Time => LossRequest { params, goal: Some(Goal::Time(Duration::from_millis(self.time_ms))) },
        }
    }
}

/// What is asked for.
#[derive(Clone, Debug, PartialEq)]
pub struct LossRequest {
    /// The numbers of scenes and the sampler count where there is no goal.
    pub params: LossParams,
    pub goal: Option<Goal>,
}

impl LossRequest {
    /// Computes it; `update` sees what is reached on the way and at last.
    ///
    /// # Errors
    /// As [`crate::loss::losses`]; [`Error::Cancelled`] may come after updates.
    pub fn run(
        &self,
        ground_truth: &Material<f32>,
        predictions: &[&Material<f32>],
        progress: &Progress,
        mut update: impl FnMut(Reached),
    ) -> Result<(), Error> {
        let LossParams { seed, convention, .. } = &self.params;
        match self.goal {
            None => prefix::losses(losses_of_f32, ground_truth, predictions, &self.params, progress, update),
            Some(goal) => {
                let seen = |reached: &Reached| update(reached.clone());
                let (truth, preds) = (ground_truth, predictions);
                adaptive::losses(losses_of_f32, truth, preds, *seed, convention, goal, progress, seen)
                    .map(|_| ())
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_default_is_what_the_papers_report_and_hidden_fields_change_no_request() {
        let settings = LossSettings::default();
        let request = settings.request(Convention::default());
        assert_eq!(request, LossRequest { params: LossParams::default(), goal: None });
        for ask in [Ask::Accuracy, Ask::Time] {
            let settings = LossSettings { ask, ..settings.clone() };
            let other = LossSettings {
                near: 60,
                distant: 2,
                sampler: Sampler::Sobol,
                texels: Texels::Sampled(9),
                ..settings.clone()
            };
            assert_eq!(settings.request(Convention::default()), other.request(Convention::default()));
            assert_ne!(settings.request(Convention::default()), request);
        }
    }
}
