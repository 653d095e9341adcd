//! The floor: the loss between a ground truth and itself within the steps that its maps are stored in.

use rand::rngs::ChaCha8Rng;
use rand::{RngExt as _, SeedableRng as _};

use super::storage::{Storage, Transfer};
use crate::error::Error;
use crate::loss::{Comparison, Estimate, Request, Sampling, Texels};
use crate::material::{Material, Planes};
use crate::model::convention::Convention;
use crate::model::sampler::Sampler;
use crate::progress::Progress;

/// Dithered copies that are compared with the ground truth.
const COPIES: u64 = 2;
/// Scenes: near-field, distant.
const SCENES: [usize; 2] = [128, 64];
/// Texels of a scene up to which all are compared; of larger maps an eighth as many.
const TEXELS: usize = 1 << 16;

/// The material with every stored value moved by up to half a step of its map, uniformly; normals are normalized again.
///
/// # Errors
/// Those of [`Material::new`], which values of a material do not give.
pub fn dithered(material: &Material<f32>, storage: &Storage, seed: u64) -> Result<Material<f32>, Error> {
    let mut generator = ChaCha8Rng::seed_from_u64(seed);
    let mut moved = |plane: &[f32], step: f64, transfer: Transfer| -> Vec<f32> {
        let step = step as f32;
        let one = |x: &f32| {
            let stored = transfer.encode(*x) + step * (generator.random::<f32>() - 0.5);
            transfer.decode(stored.clamp(0.0, 1.0))
        };
        plane.iter().map(one).collect()
    };
    let Planes { normal, diffuse, specular, roughness } = material.planes();
    let [of_normal, of_diffuse, of_specular, of_roughness] = storage.steps;
    // Components of normals are stored as (n + 1) / 2.
    let mut vector = |plane: &Vec<f32>| -> Vec<f32> {
        let stored: Vec<f32> = plane.iter().map(|x| 0.5 * x + 0.5).collect();
        moved(&stored, of_normal, Transfer::Linear).into_iter().map(|x| 2.0 * x - 1.0).collect()
    };
    let normal = normal.each_ref().map(&mut vector);
    let planes = Planes {
        normal,
        diffuse: diffuse.each_ref().map(|plane| moved(plane, of_diffuse, storage.colours)),
        specular: specular.each_ref().map(|plane| moved(plane, of_specular, storage.specular)),
        roughness: moved(roughness, of_roughness, Transfer::Linear),
    };
    Material::new(material.name(), material.width(), material.height(), planes)
}

/// The loss that a ground truth cannot resolve: the expected loss between it and a copy that is [`dithered`].
///
/// # Errors
/// [`Error::Cancelled`].
pub fn floor(
    ground_truth: &Material<f32>,
    storage: &Storage,
    convention: &Convention,
    seed: u64,
    progress: &Progress,
) -> Result<Estimate, Error> {
    let copies = (0..COPIES).map(|copy| dithered(ground_truth, storage, seed.wrapping_add(copy)));
    let copies = copies.collect::<Result<Vec<_>, Error>>()?;
    let comparison = Comparison::new(ground_truth, &copies.iter().collect::<Vec<_>>(), *convention)?;
    let [near, distant] = SCENES;
    let all = ground_truth.width() * ground_truth.height() <= TEXELS;
    let texels = if all { Texels::All } else { Texels::Sampled(TEXELS / 8) };
    let sampling = Sampling { near, distant, seed, sampler: Sampler::Sobol, texels };
    let outcome = comparison.without_pilot().run(&Request::Scenes(sampling), progress)?;
    let mean = |scene: usize| {
        outcome.losses.iter().map(|loss| loss.per_scene[scene]).sum::<f64>() / outcome.losses.len() as f64
    };
    let per_scene: Vec<f64> = (0..outcome.scenes.len()).map(mean).collect();
    Ok(Estimate::of_sampled(Sampler::Sobol, &outcome.scenes, &per_scene))
}
