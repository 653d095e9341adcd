//! The losses of many scenes on the same few texels: for maps over directions and for searches, where scenes are compared
//! with one another.

use super::comparison::{Comparison, Compute};
use super::different_texels::DifferentTexels;
use crate::error::Error;
use crate::model::sampler::Sampler;
use crate::model::scene::{Kind, Scene};
use crate::progress::Progress;

/// Independent random subsets of the texels of a comparison, the same in every scene.
#[derive(Clone, Debug, PartialEq)]
pub struct SharedTexels {
    /// Texels as row * width + column. A single subset holds all that matter.
    subsets: Vec<Vec<usize>>,
    /// The part of all texels that the subsets are taken from: on the others the loss is 0.
    share: f64,
}

/// The loss of a scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SceneLoss {
    pub loss: f64,
    /// Its standard error, which is due to the choice of texels.
    pub standard_error: f64,
}

impl SharedTexels {
    /// `number` subsets of `count` texels; one of all texels where there are no more.
    pub fn new<T: Compute>(comparison: &Comparison<'_, T>, [number, count]: [usize; 2], seed: u64) -> Self {
        let [width, height] = comparison.ground_truth().size();
        let random = |index, size| Sampler::Random.texels(seed, Kind::Near, index, count, size);
        let few = |texels: &Vec<usize>| texels.len() <= number * count;
        match DifferentTexels::of(comparison) {
            Some(DifferentTexels { texels, share }) if few(&texels) => Self { subsets: vec![texels], share },
            Some(DifferentTexels { texels, share }) => {
                let subset = |index| random(index, [texels.len(), 1]).into_iter().map(|at| texels[at]);
                Self { subsets: (0..number).map(|index| subset(index).collect()).collect(), share }
            }
            None if width * height <= number * count => {
                Self { subsets: vec![(0..width * height).collect()], share: 1.0 }
            }
            None => {
                let subsets = (0..number).map(|index| random(index, [width, height])).collect();
                Self { subsets, share: 1.0 }
            }
        }
    }

    /// For each prediction the loss of each scene.
    ///
    /// # Errors
    /// Those of the backend.
    pub fn losses<T: Compute>(
        &self,
        comparison: &Comparison<'_, T>,
        scenes: &[Scene],
        progress: &Progress,
    ) -> Result<Vec<Vec<SceneLoss>>, Error> {
        let of_subset =
            |texels: &Vec<usize>| T::cpu().scene_losses(comparison, scenes, Some(texels), progress);
        let by_subset = self.subsets.iter().map(of_subset).collect::<Result<Vec<_>, _>>()?;
        let one = |p: usize, scene: usize| {
            let values: Vec<f64> = by_subset.iter().map(|losses| self.share * losses[p][scene]).collect();
            let count = values.len() as f64;
            let loss = values.iter().sum::<f64>() / count;
            let squares = values.iter().map(|value| (value - loss).powi(2)).sum::<f64>();
            let standard_error = if count > 1.0 { (squares / (count * (count - 1.0))).sqrt() } else { 0.0 };
            SceneLoss { loss, standard_error }
        };
        let of_prediction = |p| (0..scenes.len()).map(|scene| one(p, scene)).collect();
        Ok((0..comparison.predictions().len()).map(of_prediction).collect())
    }
}
