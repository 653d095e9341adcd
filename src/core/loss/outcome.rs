//! The outcome of a comparison: scenes, losses with their errors, paired differences.

use std::fmt;

use serde::Serialize;

use super::comparison::{Comparison, Compute};
use super::pilot::Pilot;
use super::request::Sampling;
use super::statistics::Estimate;
use crate::error::Error;
use crate::material::Material;
use crate::model::sampler::Sampler;
use crate::model::scene::Scene;
use crate::progress::Progress;

/// The loss of one prediction.
#[derive(Clone, Debug, PartialEq)]
pub struct Loss {
    /// The name of the prediction.
    pub prediction: String,
    /// The loss over all scenes, with its error.
    pub estimate: Estimate,
    /// The loss of each scene, in the order of the scenes: the mean over texels and RGB of
    /// `|ln(R_gt + epsilon) - ln(R_pred + epsilon)|`.
    pub per_scene: Vec<f64>,
}

/// The losses of all predictions over the same scenes.
#[derive(Clone, Debug, PartialEq)]
pub struct Outcome {
    /// The sampling that gives these losses; `None` where the scenes were listed.
    pub sampling: Option<Sampling>,
    /// The scenes: near-field ones before distant ones where they were sampled.
    pub scenes: Vec<Scene>,
    /// One per prediction.
    pub losses: Vec<Loss>,
    /// What the intervals come from; `None`: the losses of the scenes.
    pub(super) pilot: Option<Pilot>,
}

/// What 95% intervals come from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "lowercase")]
pub enum IntervalSource {
    /// The distribution of the losses of many other scenes: for few sampled scenes.
    Pilot,
    /// The losses of the scenes themselves: for many sampled scenes, and for listed ones, which have no distribution.
    Scenes,
}

impl fmt::Display for IntervalSource {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Pilot => "pilot",
            Self::Scenes => "scenes",
        })
    }
}

impl<T: Compute> Comparison<'_, T> {
    /// The outcome of the loss of each of `scenes` for each prediction; intervals come from `pilot`, if there is one.
    pub(super) fn outcome(
        &self,
        sampling: Option<Sampling>,
        scenes: Vec<Scene>,
        per_scene: Vec<Vec<f64>>,
        pilot: Option<Pilot>,
    ) -> Outcome {
        let sampler = sampling.map_or(Sampler::Random, |sampling| sampling.sampler);
        let loss = |(index, (prediction, per_scene)): (usize, (&&Material<T>, Vec<f64>))| {
            let mut estimate = Estimate::of_sampled(sampler, &scenes, &per_scene);
            if let Some(pilot) = &pilot {
                estimate.interval95 = Some(pilot.interval_of_loss(index, estimate.mean));
            }
            Loss { prediction: prediction.name().to_owned(), estimate, per_scene }
        };
        let losses = self.predictions().iter().zip(per_scene).enumerate().map(loss).collect();
        Outcome { sampling, scenes, losses, pilot }
    }

    /// The pilot of a request for `sampling`, unless it needs none.
    ///
    /// # Errors
    /// [`Error::Cancelled`].
    pub(super) fn pilot(&self, sampling: &Sampling, progress: &Progress) -> Result<Option<Pilot>, Error> {
        if self.has_pilot() { Pilot::run(self, sampling, progress) } else { Ok(None) }
    }
}

impl Outcome {
    /// What the intervals come from.
    pub fn interval_source(&self) -> IntervalSource {
        if self.pilot.is_some() { IntervalSource::Pilot } else { IntervalSource::Scenes }
    }

    /// The largest [`Estimate::relative_error95`] of any loss.
    pub fn relative_error95(&self) -> f64 {
        self.losses.iter().map(|loss| loss.estimate.relative_error95()).fold(0.0, f64::max)
    }

    /// The loss of the prediction with index `of` - that with index `from`, on the same scenes: negative where the first is closer to
    /// the ground truth.
    ///
    /// # Panics
    /// Where there is no such prediction, as indexing a slice does.
    pub fn difference(&self, of: usize, from: usize) -> Estimate {
        let sampler = self.sampling.map_or(Sampler::Random, |sampling| sampling.sampler);
        let [first, second] = [of, from].map(|index| self.losses[index].per_scene.as_slice());
        let mut e = Estimate::of_difference(sampler, &self.scenes, first, second);
        if let Some(pilot) = &self.pilot {
            e.interval95 = Some(pilot.interval_of_difference(of, from, e.mean));
        }
        e
    }
}
