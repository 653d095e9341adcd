//! Algorithm 1: the rendering loss of predictions against a ground truth over given scenes.

pub mod adaptive;
pub mod fused;
pub mod prefix;
mod statistics;
mod texels;

use std::str::FromStr;

use rayon::prelude::*;
use serde::Serialize;

pub use fused::{losses_f32, losses_of_f32};
pub use statistics::Estimate;
pub use texels::{Draw, Texels};

use crate::error::Error;
use crate::material::Material;
use crate::math::real::Real;
use crate::model::brdf::Model;
use crate::model::convention::Convention;
use crate::model::sampler::Sampler;
use crate::model::scene::Scene;
use crate::progress::Progress;
use crate::render::render_texel;

/// Rows are summed within blocks of this many texels, and blocks in order: threads never change a sum.
const TEXELS_PER_BLOCK: usize = 4096;

/// What the loss is asked for: the same struct behind the command line and the panel.
#[derive(Clone, Debug, PartialEq)]
pub struct LossParams {
    /// N_S, the number of near-field scenes.
    pub near: usize,
    /// N_D, the number of distant scenes.
    pub distant: usize,
    /// Names the scenes: the i-th scene depends on it and on i alone.
    pub seed: u64,
    pub convention: Convention,
    pub precision: Precision,
    pub sampler: Sampler,
    pub texels: Texels,
}

impl Default for LossParams {
    fn default() -> Self {
        Self {
            near: 6,
            distant: 3,
            seed: 0,
            convention: Convention::default(),
            precision: Precision::F32,
            sampler: Sampler::Random,
            texels: Texels::All,
        }
    }
}

impl LossParams {
    /// Most scenes that a loss may be asked for, of both kinds together.
    pub const MAX_SCENES: usize = 10_000_000;

    /// The scenes that these parameters name.
    ///
    /// # Errors
    /// [`Error::InvalidRequest`] without scenes or with more than [`LossParams::MAX_SCENES`].
    pub fn scenes(&self) -> Result<Vec<Scene>, Error> {
        let count = self.near.saturating_add(self.distant);
        if count == 0 {
            return Err(Error::InvalidRequest(
                "a loss needs at least one scene; ask for more near-field or distant scenes".to_owned(),
            ));
        }
        if count > Self::MAX_SCENES {
            return Err(Error::InvalidRequest(format!(
                "{count} scenes are more than {}; ask for fewer",
                Self::MAX_SCENES
            )));
        }
        Ok(self.sampler.scenes(self.seed, self.near, self.distant, &self.convention))
    }

    /// What draws the scenes and their texels.
    pub fn draw(&self) -> Draw {
        Draw { sampler: self.sampler, seed: self.seed, texels: self.texels }
    }
}

/// What renderings are computed in.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Precision {
    #[default]
    F32,
    F64,
}

impl FromStr for Precision {
    type Err = Error;

    fn from_str(name: &str) -> Result<Self, Error> {
        match name {
            "f32" => Ok(Self::F32),
            "f64" => Ok(Self::F64),
            _ => Err(Error::UnknownName {
                what: "precision",
                found: name.to_owned(),
                known: "f32, f64".to_owned(),
            }),
        }
    }
}

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

impl Loss {
    /// The loss of the prediction called `name` from that in each of `scenes`.
    pub(crate) fn new(name: &str, scenes: &[Scene], per_scene: Vec<f64>) -> Self {
        let estimate = Estimate::of_scenes(scenes, &per_scene);
        Self { prediction: name.to_owned(), estimate, per_scene }
    }

    /// The same loss, with the error of scenes that `sampler` drew: quasi-random ones are no independent ones.
    #[must_use]
    pub fn sampled_by(self, sampler: Sampler, scenes: &[Scene]) -> Self {
        Self { estimate: Estimate::of_sampled(sampler, scenes, &self.per_scene), ..self }
    }
}

/// Algorithm 1 in one precision: [`losses_of`] or a faster twin of it.
pub type Losses<T> = fn(
    &Material<T>,
    &[&Material<T>],
    Option<&[usize]>,
    &[Scene],
    &Convention,
    &Progress,
) -> Result<Vec<Loss>, Error>;

/// The losses of `predictions` against `ground_truth` over `scenes`, in the order of the predictions.
///
/// All predictions see the same scenes. The result does not depend on the number of threads.
///
/// # Errors
/// [`Error::SizesDiffer`], [`Error::UnusableScene`], [`Error::InvalidRequest`] without scenes, [`Error::Cancelled`].
pub fn losses<T: Real>(
    ground_truth: &Material<T>,
    predictions: &[&Material<T>],
    scenes: &[Scene],
    convention: &Convention,
    progress: &Progress,
) -> Result<Vec<Loss>, Error> {
    losses_of(ground_truth, predictions, None, scenes, convention, progress)
}

/// [`losses`] over some texels only, given as row * width + column; those that are given twice count twice. `None`: all.
///
/// # Errors
/// As [`losses`].
///
/// # Panics
/// Where there is no such texel, as indexing a slice does.
pub fn losses_of<T: Real>(
    ground_truth: &Material<T>,
    predictions: &[&Material<T>],
    texels: Option<&[usize]>,
    scenes: &[Scene],
    convention: &Convention,
    progress: &Progress,
) -> Result<Vec<Loss>, Error> {
    check(ground_truth, predictions, scenes)?;
    let model = Model::from(convention);
    let epsilon = T::of(convention.epsilon);
    let listed = texels;
    let texels = listed.map_or(ground_truth.width() * ground_truth.height(), <[usize]>::len);
    let blocks = texels.div_ceil(TEXELS_PER_BLOCK);
    progress.begin((scenes.len() * blocks) as u64);

    let sums = (0..scenes.len() * blocks)
        .into_par_iter()
        .map(|job| {
            let (scene, block) = (&scenes[job / blocks], job % blocks);
            let range = block * TEXELS_PER_BLOCK..texels.min((block + 1) * TEXELS_PER_BLOCK);
            let rays = scene.rays();
            let range = range.map(|at| listed.map_or(at, |texels| texels[at]));
            let sums = block_sums(ground_truth, predictions, range, |material, column, row| {
                render_texel(material, &model, &rays, column, row).map(|radiance| (radiance + epsilon).ln())
            });
            progress.step()?;
            Ok(sums)
        })
        .collect::<Result<Vec<_>, Error>>()?;

    let count = 3.0 * texels as f64;
    Ok(predictions
        .iter()
        .enumerate()
        .map(|(p, prediction)| {
            let scene_mean = |sums: &[Vec<f64>]| sums.iter().map(|block| block[p]).sum::<f64>() / count;
            let per_scene: Vec<f64> = sums.chunks(blocks).map(scene_mean).collect();
            Loss::new(prediction.name(), scenes, per_scene)
        })
        .collect())
}

/// For each prediction the sum of `|log R_gt - log R_pred|` over `texels` and RGB.
fn block_sums<T: Real>(
    ground_truth: &Material<T>,
    predictions: &[&Material<T>],
    texels: impl Iterator<Item = usize>,
    log_radiance: impl Fn(&Material<T>, usize, usize) -> [T; 3],
) -> Vec<f64> {
    let width = ground_truth.width();
    let mut sums = vec![0.0; predictions.len()];
    for index in texels {
        let (column, row) = (index % width, index / width);
        let expected = log_radiance(ground_truth, column, row);
        for (sum, prediction) in sums.iter_mut().zip(predictions) {
            let got = log_radiance(prediction, column, row);
            for (a, b) in expected.into_iter().zip(got) {
                *sum += (a - b).abs().f64();
            }
        }
    }
    sums
}

/// Whether a loss can be computed: there are scenes, all can be rendered, and sizes agree.
pub(crate) fn check<T: Real>(
    ground_truth: &Material<T>,
    predictions: &[&Material<T>],
    scenes: &[Scene],
) -> Result<(), Error> {
    if scenes.is_empty() {
        return Err(Error::InvalidRequest("a loss needs at least one scene".to_owned()));
    }
    for scene in scenes {
        scene.check().map_err(|problem| Error::UnusableScene { problem })?;
    }
    for prediction in predictions {
        check_same_size(ground_truth, prediction)?;
    }
    Ok(())
}

/// Whether a prediction can be compared with its ground truth texel by texel.
///
/// # Errors
/// [`Error::SizesDiffer`].
pub fn check_same_size<T: Real>(ground_truth: &Material<T>, prediction: &Material<T>) -> Result<(), Error> {
    if ground_truth.size() == prediction.size() {
        return Ok(());
    }
    Err(Error::SizesDiffer {
        first: format!("ground truth {}", ground_truth.name()),
        first_size: ground_truth.size(),
        second: format!("prediction {}", prediction.name()),
        second_size: prediction.size(),
        remedy: "resize them to one size",
    })
}
