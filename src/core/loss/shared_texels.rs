//! The losses of many scenes on the same few texels, for searches, where scenes are compared with one another.

use super::comparison::{Comparison, Compute};
use super::different_texels::DifferentTexels;
use crate::error::Error;
use crate::model::sampler::Sampler;
use crate::model::scene::{Kind, Scene};
use crate::progress::Progress;

/// A random subset of the texels of a comparison, the same in every scene.
#[derive(Clone, Debug, PartialEq)]
pub struct SharedTexels {
    /// Texels as row * width + column.
    texels: Vec<usize>,
    /// The part of all texels that they are taken from: on the others the loss is 0.
    share: f64,
}

impl SharedTexels {
    /// `count` texels; all that matter where there are no more.
    pub fn new<T: Compute>(comparison: &Comparison<'_, T>, count: usize) -> Self {
        let [width, height] = comparison.ground_truth().size();
        let random = |size| Sampler::Random.texels(0, Kind::Near, 0, count, size);
        match DifferentTexels::of(comparison) {
            Some(DifferentTexels { texels, share }) if texels.len() <= count => Self { texels, share },
            Some(DifferentTexels { texels, share }) => {
                Self { texels: random([texels.len(), 1]).into_iter().map(|at| texels[at]).collect(), share }
            }
            None if width * height <= count => Self { texels: (0..width * height).collect(), share: 1.0 },
            None => Self { texels: random([width, height]), share: 1.0 },
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
    ) -> Result<Vec<Vec<f64>>, Error> {
        let mut losses = T::cpu().scene_losses(comparison, scenes, Some(&self.texels), progress)?;
        losses.iter_mut().flatten().for_each(|loss| *loss *= self.share);
        Ok(losses)
    }
}
