//! The floor: the loss that a ground truth cannot resolve, since its maps have steps or its captures differ.

use super::dither::dithered;
use super::samples::LossSamples;
use crate::error::Error;
use svbrdf_core::error::Error as CoreError;
use svbrdf_core::loss::{Comparison, Compute as _, Estimate, Outcome, Request, Sampling, Texels};
use svbrdf_core::material::Material;
use svbrdf_core::model::convention::Convention;
use svbrdf_core::model::sampler::Sampler;
use svbrdf_core::model::scene::Scene;
use svbrdf_core::parallel;
use svbrdf_core::progress::Progress;
use svbrdf_files::read::Storage;

/// Dithered copies that are compared with the ground truth.
const COPIES: usize = 2;
/// Scenes: near-field, distant.
const SCENES: [usize; 2] = [128, 64];
/// Texels of a scene up to which all are compared, and those of larger maps: with more of them, its error stays that of the scenes.
const TEXELS: [usize; 2] = [1 << 16, 1 << 11];

/// The expected loss between a ground truth and a copy that is [`dithered`].
///
/// # Errors
/// [`Cancelled`](Error::is_cancelled).
pub fn floor(
    ground_truth: &Material<f32>,
    storage: &Storage,
    convention: &Convention,
    seed: u64,
    progress: &Progress,
) -> Result<Estimate, Error> {
    let sampling = sampling(ground_truth, seed);
    let scenes = sampling.scenes(convention)?;
    let samples = LossSamples::of(&sampling, &scenes, ground_truth.grid());
    let held = samples.as_ref().map_or_else(|| ground_truth.clone(), |samples| samples.of_map(ground_truth));
    let dithered = |copy: usize| dithered(&held, storage, seed.wrapping_add(copy as u64));
    let copies = parallel::try_map(COPIES, dithered)?;
    let copies: Vec<_> = copies.iter().collect();
    let Some(samples) = samples else {
        return Ok(mean(&[losses(ground_truth, &copies, convention, seed, progress)?]));
    };
    let comparison = samples.placed(Comparison::new(&held, &copies, *convention)?);
    let of_scene = |number: usize| samples.of_scene(number).collect();
    let losses = f32::cpu().losses_on_own_texels(&comparison, &scenes, &of_scene, progress)?;
    Ok(mean_of(&scenes, &losses.iter().map(Vec::as_slice).collect::<Vec<_>>()))
}

fn losses(
    first: &Material<f32>,
    others: &[&Material<f32>],
    convention: &Convention,
    seed: u64,
    progress: &Progress,
) -> Result<Outcome, CoreError> {
    let comparison = Comparison::new(first, others, *convention)?.without_pilot();
    comparison.run(&Request::Scenes(sampling(first, seed)), progress)
}

fn sampling(ground_truth: &Material<f32>, seed: u64) -> Sampling {
    let [near, distant] = SCENES;
    let all = ground_truth.width() * ground_truth.height() <= TEXELS[0];
    let texels = if all { Texels::All } else { Texels::Sampled(TEXELS[1]) };
    Sampling { near, distant, seed, sampler: Sampler::Sobol, texels }
}

/// The mean over all comparisons, which are in the same scenes.
fn mean(outcomes: &[Outcome]) -> Estimate {
    let losses = outcomes.iter().flat_map(|outcome| &outcome.losses);
    let losses: Vec<_> = losses.map(|loss| loss.per_scene.as_slice()).collect();
    mean_of(outcomes.first().map_or(&[], |outcome| &outcome.scenes), &losses)
}

/// The mean over the losses of several comparisons in each scene.
fn mean_of(scenes: &[Scene], losses: &[&[f64]]) -> Estimate {
    let of_scene = |scene: usize| losses.iter().map(|loss| loss[scene]).sum::<f64>() / losses.len() as f64;
    let per_scene: Vec<f64> = (0..scenes.len()).map(of_scene).collect();
    Estimate::of_sampled(Sampler::Sobol, scenes, &per_scene)
}
