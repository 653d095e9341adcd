//! What a comparison gives.

use super::comparison::Comparison;
use super::request::Sampling;
use super::statistics::Estimate;
use crate::material::Material;
use crate::math::real::Real;
use crate::model::sampler::Sampler;
use crate::model::scene::Scene;

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
}

impl<T: Real> Comparison<'_, T> {
    /// The outcome of the loss of each of `scenes` for each prediction.
    pub(super) fn outcome(
        &self,
        sampling: Option<Sampling>,
        scenes: Vec<Scene>,
        per_scene: Vec<Vec<f64>>,
    ) -> Outcome {
        let sampler = sampling.map_or(Sampler::Random, |sampling| sampling.sampler);
        let loss = |(prediction, per_scene): (&&Material<T>, Vec<f64>)| Loss {
            prediction: prediction.name().to_owned(),
            estimate: Estimate::of_sampled(sampler, &scenes, &per_scene),
            per_scene,
        };
        let losses = self.predictions().iter().zip(per_scene).map(loss).collect();
        Outcome { sampling, scenes, losses }
    }
}

impl Outcome {
    /// The largest [`Estimate::relative_error95`] of any loss.
    pub fn relative_error95(&self) -> f64 {
        self.losses.iter().map(|loss| loss.estimate.relative_error95()).fold(0.0, f64::max)
    }

    /// `loss - other`, both of this outcome, on the same scenes: negative where `loss` is closer to the ground truth.
    pub fn difference(&self, loss: &Loss, other: &Loss) -> Estimate {
        let sampler = self.sampling.map_or(Sampler::Random, |sampling| sampling.sampler);
        Estimate::of_difference(sampler, &self.scenes, &loss.per_scene, &other.per_scene)
    }
}
