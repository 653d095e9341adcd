//! The ladder: losses between renderings that are averaged over larger and larger blocks.

use rayon::prelude::*;
use schemars::JsonSchema;
use serde::Serialize;

use super::filtered::filtered_roughness;
use svbrdf_core::error::Error;
use svbrdf_core::image::Image;
use svbrdf_core::material::Material;
use svbrdf_core::model::convention::Convention;
use svbrdf_core::model::scene::Scene;
use svbrdf_core::progress::Progress;
use svbrdf_core::render::render_f32;

/// The loss between averages over blocks of texels, and the roughness of these blocks.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Rung {
    /// Columns and rows of a block: 2^k.
    pub side: usize,
    /// The mean over scenes, blocks and RGB of `|ln(<p> + epsilon) - ln(<g> + epsilon)|`.
    pub loss: f64,
    /// The [`filtered_roughness`] of the ground truth and of the prediction.
    pub roughness: [f64; 2],
}

/// The rungs from single texels to the largest blocks that fit; rows and columns that do not fill a block do not count.
///
/// # Errors
/// [`Error::UnusableScene`], [`Error::Cancelled`].
pub fn ladder(
    ground_truth: &Material<f32>,
    prediction: &Material<f32>,
    scenes: &[Scene],
    convention: &Convention,
    progress: &Progress,
) -> Result<Vec<Rung>, Error> {
    let materials = [ground_truth, prediction];
    let levels = ground_truth.width().min(ground_truth.height()).ilog2() + 1;
    let of_scene = |scene: &Scene| {
        let render = |material| render_f32(material, scene, convention, &progress.part());
        let [mut g, mut p] = [render(ground_truth)?, render(prediction)?];
        let mut losses = vec![difference(&g, &p, convention.epsilon)];
        for _ in 1..levels {
            (g, p) = (halved(&g), halved(&p));
            losses.push(difference(&g, &p, convention.epsilon));
        }
        progress.step()?;
        Ok(losses)
    };
    let by_scene = scenes.par_iter().map(of_scene).collect::<Result<Vec<_>, Error>>()?;
    let rung = |level: u32| {
        let sum = by_scene.iter().map(|losses| losses[level as usize]).sum::<f64>();
        let roughness = materials.map(|material| filtered_roughness(material, level).unwrap_or(f64::NAN));
        Rung { side: 1 << level, loss: sum / by_scene.len() as f64, roughness }
    };
    Ok((0..levels).into_par_iter().map(rung).collect())
}

/// The image with the mean of 2 x 2 pixels in each; a last odd row or column is left out.
fn halved(image: &Image<f32>) -> Image<f32> {
    let [width, height] = [image.width / 2, image.height / 2];
    let mean = |index: usize| {
        let at = index / width * 2 * image.width + index % width * 2;
        let four = [at, at + 1, at + image.width, at + image.width + 1].map(|i| image.pixels[i]);
        [0, 1, 2].map(|c| 0.25 * four.iter().map(|pixel| pixel[c]).sum::<f32>())
    };
    Image { width, height, pixels: (0..width * height).map(mean).collect() }
}

fn difference(g: &Image<f32>, p: &Image<f32>, epsilon: f64) -> f64 {
    let epsilon = epsilon as f32;
    let of_pair = |(g, p): (&f32, &f32)| f64::from(((p + epsilon) / (g + epsilon)).ln().abs());
    let [g, p] = [g.pixels.as_flattened(), p.pixels.as_flattened()];
    g.iter().zip(p).map(of_pair).sum::<f64>() / g.len() as f64
}
