//! Algorithm 1 as it is written: the reference, in any precision, and the loss by the members of the grammar.

use super::comparison::{Backend, Comparison, Compute};
use crate::error::Error;
use crate::material::Material;
use crate::math::real::Real;
use crate::model::brdf::Model;
use crate::model::grammar::words::Norm;
use crate::model::scene::Scene;
use crate::parallel;
use crate::progress::Progress;
use crate::render::radiance;

/// Rows are summed within blocks of this many texels, and blocks in order: threads never change a sum.
const TEXELS_PER_BLOCK: usize = 4096;

/// The plain loss: one texel and scene after the other. Members of the grammar are rendered in f64, and all logarithms are.
#[derive(Clone, Copy, Debug, Default)]
pub struct Plain;

impl Compute for f64 {
    fn cpu() -> &'static dyn Backend<Self> {
        &Plain
    }
}

impl<T: Real> Backend<T> for Plain {
    fn scene_losses(
        &self,
        comparison: &Comparison<'_, T>,
        scenes: &[Scene],
        texels: Option<&[usize]>,
        progress: &Progress,
    ) -> Result<Vec<Vec<f64>>, Error> {
        let ground_truth = comparison.ground_truth();
        let predictions = comparison.predictions();
        let convention = comparison.convention();
        let (model, epsilon, norm) = (Model::from(convention), convention.epsilon, convention.norm());
        let logs = norm == Norm::LogL1;
        let is_squared = matches!(norm, Norm::Mse | Norm::Rmse);
        let (grid, places) = comparison.places();
        let listed = texels;
        let texels = listed.map_or(ground_truth.width() * ground_truth.height(), <[usize]>::len);
        let blocks = texels.div_ceil(TEXELS_PER_BLOCK);
        progress.begin((scenes.len() * blocks) as u64);

        let sums = parallel::try_map(scenes.len() * blocks, |index| {
            let (scene, block) = (&scenes[index / blocks], index % blocks);
            let range = block * TEXELS_PER_BLOCK..texels.min((block + 1) * TEXELS_PER_BLOCK);
            let rays = scene.rays();
            let range = range.map(|at| listed.map_or(at, |texels| texels[at]));
            let value = |material: &Material<T>, texel: usize| {
                let place = places.map_or(texel, |places| places[texel]);
                let radiance = radiance(&material.texel(texel), &model, &rays, grid, place);
                if logs { radiance.map(|radiance| (radiance + epsilon).ln()) } else { radiance }
            };
            let difference = |a: f64, b: f64| if is_squared { (a - b) * (a - b) } else { (a - b).abs() };
            let sums = block_sums(ground_truth, predictions, range, value, difference);
            progress.step()?;
            Ok::<_, Error>(sums)
        })?;

        let count = 3.0 * texels as f64;
        let per_scene = |p: usize| {
            let mean = |sums: &[Vec<f64>]| {
                let mean = sums.iter().map(|block| block[p]).sum::<f64>() / count;
                if norm == Norm::Rmse { mean.sqrt() } else { mean }
            };
            sums.chunks(blocks).map(mean).collect()
        };
        Ok((0..predictions.len()).map(per_scene).collect())
    }
}

/// For each prediction the mean over `scenes` of what each texel and channel adds to the loss. A row is one step of `progress`.
///
/// # Errors
/// [`Error::Cancelled`]; [`Error::NotComputed`] where the loss is no mean over texels.
pub(super) fn texel_means(
    comparison: &Comparison<'_, f32>,
    scenes: &[Scene],
    progress: &Progress,
) -> Result<Vec<Vec<[f32; 3]>>, Error> {
    let (ground_truth, predictions) = (comparison.ground_truth(), comparison.predictions());
    let (convention, model) = (comparison.convention(), Model::from(comparison.convention()));
    let Some(term) = convention.norm().term(convention.epsilon) else {
        return Err(Error::NotComputed { what: "a loss of single texels", convention: convention.name });
    };
    let rays: Vec<_> = scenes.iter().map(Scene::rays).collect();
    let mean = |prediction: &Material<f32>, column: usize, row: usize| {
        let mut sums = [0.0; 3];
        for rays in &rays {
            let place = row * ground_truth.width() + column;
            let [a, b] = [ground_truth, prediction]
                .map(|m| radiance(&m.texel(place), &model, rays, ground_truth.grid(), place));
            (0..3).for_each(|c| sums[c] += term(a[c], b[c]));
        }
        sums.map(|sum| (sum / scenes.len() as f64) as f32)
    };
    progress.begin((ground_truth.height() * predictions.len()) as u64);
    let of = |prediction: &&Material<f32>| {
        let row = |row: usize| {
            progress.step()?;
            Ok::<_, Error>(
                (0..ground_truth.width()).map(|column| mean(prediction, column, row)).collect::<Vec<_>>(),
            )
        };
        Ok(parallel::try_map(ground_truth.height(), row)?.concat())
    };
    predictions.iter().map(of).collect()
}

/// For each prediction the sum of the differences of what `value` gives over `texels` and RGB.
fn block_sums<T: Real>(
    ground_truth: &Material<T>,
    predictions: &[&Material<T>],
    texels: impl Iterator<Item = usize>,
    value: impl Fn(&Material<T>, usize) -> [f64; 3],
    difference: impl Fn(f64, f64) -> f64,
) -> Vec<f64> {
    let mut sums = vec![0.0; predictions.len()];
    for index in texels {
        let expected = value(ground_truth, index);
        for (sum, prediction) in sums.iter_mut().zip(predictions) {
            let got = value(prediction, index);
            for (a, b) in expected.into_iter().zip(got) {
                *sum += difference(a, b);
            }
        }
    }
    sums
}
