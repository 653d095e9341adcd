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

/// Values that share a logarithm.
const FEW: usize = 24;

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
    let [of_truth, of_prediction] = materials.map(filtered_roughness);
    let rung = |(level, roughness): (usize, (f64, f64))| {
        let sum = by_scene.iter().map(|losses| losses[level]).sum::<f64>();
        Rung { side: 1 << level, loss: sum / by_scene.len() as f64, roughness: roughness.into() }
    };
    Ok(of_truth.into_iter().zip(of_prediction).enumerate().map(rung).collect())
}

/// The image with the mean of 2 x 2 pixels in each; a last odd row or column is left out.
fn halved(image: &Image<f32>) -> Image<f32> {
    let [width, height] = [image.width / 2, image.height / 2];
    let mut pixels = Vec::with_capacity(width * height);
    for rows in image.pixels.chunks_exact(2 * image.width) {
        let (upper, lower) = rows.split_at(image.width);
        let pairs = upper.as_chunks::<2>().0.iter().zip(lower.as_chunks::<2>().0);
        let mean = |([a, b], [c, d]): (&[[f32; 3]; 2], &[[f32; 3]; 2])| {
            [0, 1, 2].map(|i| 0.25 * (a[i] + b[i] + c[i] + d[i]))
        };
        pixels.extend(pairs.map(mean));
    }
    Image { width, height, pixels }
}

/// The mean of `|ln(p + epsilon) - ln(g + epsilon)|`: a few logarithms of the larger ones over the smaller ones of several values.
fn difference(g: &Image<f32>, p: &Image<f32>, epsilon: f64) -> f64 {
    let epsilon = epsilon as f32;
    let ends = |(p, g): (&f32, &f32)| {
        let [p, g] = [p + epsilon, g + epsilon];
        [f64::from(p.max(g)), f64::from(p.min(g))]
    };
    let [g, p] = [g.pixels.as_flattened(), p.pixels.as_flattened()];
    let of_few = |(g, p): (&[f32], &[f32])| {
        let all = || p.iter().zip(g).map(ends);
        let [larger, smaller] = all().fold([1.0, 1.0], |[a, b], [larger, smaller]| [a * larger, b * smaller]);
        let ratio = larger / smaller;
        // Otherwise f64 does not hold the products of many extreme values.
        let is_held = ratio.is_finite() && smaller > f64::MIN_POSITIVE;
        if is_held { ratio.ln() } else { all().map(|[larger, smaller]| (larger / smaller).ln()).sum() }
    };
    g.chunks(FEW).zip(p.chunks(FEW)).map(of_few).sum::<f64>() / g.len() as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn differences_are_those_of_logarithms_and_hold_extreme_radiances() {
        let image = |values: &dyn Fn(usize) -> f32| {
            let pixels = (0..35).map(|i| [0, 1, 2].map(|c| values(3 * i + c))).collect();
            Image { width: 7, height: 5, pixels }
        };
        let usual = image(&|i| 0.3 * (i * 37 % 11) as f32);
        let dark = image(&|i| 1e-3 * (i * 29 % 7) as f32);
        let extreme = image(&|i| if i % 2 == 0 { 8e37 } else { 0.0 });
        for epsilon in [0.01, 1e-30] {
            for [g, p] in [[&usual, &dark], [&usual, &extreme], [&extreme, &dark]] {
                let log = |x: f32| (f64::from(x) + epsilon).ln();
                let pairs = g.pixels.as_flattened().iter().zip(p.pixels.as_flattened());
                let expected = pairs.map(|(g, p)| (log(*p) - log(*g)).abs()).sum::<f64>() / 105.0;
                let found = difference(g, p, epsilon);
                assert!((found / expected - 1.0).abs() < 1e-6, "{epsilon}: {found} {expected}");
            }
        }
    }
}
