//! A loss from a part of the texels: many scenes on few texels, without bias.
//!
//! A scene changes the loss far more than a choice of texels does. So each scene is seen on texels of its own, in which
//! every texel is as likely as any other: the loss in a scene is then known without bias, with an error that shows
//! where that of the scenes does, in how scenes or scramblings differ. The time does not depend on the size of maps.

use std::fmt;
use std::str::FromStr;

use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use super::{Loss, Losses, check};
use crate::error::Error;
use crate::material::Material;
use crate::math::real::Real;
use crate::model::convention::Convention;
use crate::model::sampler::Sampler;
use crate::model::scene::{Kind, Scene};
use crate::progress::Progress;

/// Which texels of the materials are compared in a scene.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Texels {
    #[default]
    All,
    /// So many of its own; all where that is not less.
    Sampled(usize),
}

/// What draws scenes and, where not all are compared, their texels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Draw {
    pub sampler: Sampler,
    pub seed: u64,
    pub texels: Texels,
}

impl Draw {
    /// The losses of `predictions` over `scenes`, which `self` has drawn, on its texels.
    ///
    /// # Errors
    /// Those of `kernel`.
    pub fn losses<T: Real>(
        &self,
        kernel: Losses<T>,
        ground_truth: &Material<T>,
        predictions: &[&Material<T>],
        scenes: &[Scene],
        convention: &Convention,
        progress: &Progress,
    ) -> Result<Vec<Loss>, Error> {
        self.losses_after([0, 0], kernel, ground_truth, predictions, scenes, convention, progress)
    }

    /// [`Draw::losses`] for scenes that come after so many [near-field, distant] ones of this draw.
    ///
    /// # Errors
    /// Those of `kernel`.
    #[expect(clippy::too_many_arguments, reason = "those of a loss, and which part of it")]
    pub fn losses_after<T: Real>(
        &self,
        before: [usize; 2],
        kernel: Losses<T>,
        ground_truth: &Material<T>,
        predictions: &[&Material<T>],
        scenes: &[Scene],
        convention: &Convention,
        progress: &Progress,
    ) -> Result<Vec<Loss>, Error> {
        let size = ground_truth.size();
        let sampled_by = |loss: Loss| loss.sampled_by(self.sampler, scenes);
        let count = match self.texels {
            Texels::Sampled(count) if count < size[0] * size[1] => count,
            _ => {
                let losses = kernel(ground_truth, predictions, None, scenes, convention, progress)?;
                return Ok(losses.into_iter().map(sampled_by).collect());
            }
        };
        check(ground_truth, predictions, scenes)?;
        progress.begin(scenes.len() as u64);
        let of_scene = |(scene, index): (&Scene, usize)| {
            let texels = self.sampler.texels(self.seed, scene.kind, index, count, size);
            let (scene, unseen) = (std::slice::from_ref(scene), Progress::default());
            let losses = kernel(ground_truth, predictions, Some(&texels), scene, convention, &unseen)?;
            progress.step()?;
            Ok(losses.into_iter().map(|loss| loss.per_scene[0]).collect())
        };
        let indexed: Vec<_> = scenes.iter().zip(indices(before, scenes)).collect();
        let values = indexed.into_par_iter().map(of_scene).collect::<Result<Vec<Vec<f64>>, Error>>()?;
        let of_prediction = |(p, prediction): (usize, &&Material<T>)| {
            let per_scene = values.iter().map(|of_scene| of_scene[p]).collect();
            sampled_by(Loss::new(prediction.name(), scenes, per_scene))
        };
        Ok(predictions.iter().enumerate().map(of_prediction).collect())
    }
}

/// Which one of its kind each scene is, after so many [near-field, distant] ones.
fn indices(before: [usize; 2], scenes: &[Scene]) -> impl Iterator<Item = usize> {
    let [mut near, mut distant] = before.map(|count| count..);
    scenes.iter().filter_map(move |scene| match scene.kind {
        Kind::Near => near.next(),
        Kind::Distant => distant.next(),
    })
}

impl FromStr for Texels {
    type Err = Error;

    fn from_str(text: &str) -> Result<Self, Error> {
        match (text, text.parse()) {
            ("all", _) => Ok(Self::All),
            (_, Ok(count)) if count > 0 => Ok(Self::Sampled(count)),
            _ => Err(Error::UnknownName {
                what: "number of texels",
                found: text.to_owned(),
                known: "all, or a number such as 256".to_owned(),
            }),
        }
    }
}

impl fmt::Display for Texels {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::All => f.write_str("all"),
            Self::Sampled(count) => count.fmt(f),
        }
    }
}
