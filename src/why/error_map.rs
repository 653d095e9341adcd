//! Where on the material the loss comes from: the mean log difference of each texel over all scenes.

use rayon::prelude::*;

use crate::error::Error;
use crate::image::Image;
use crate::loss::Comparison;
use crate::model::scene::Scene;
use crate::progress::Progress;
use crate::render;

/// For each prediction the mean over `scenes` of |ln(R_gt + epsilon) - ln(R_pred + epsilon)| of every texel and channel.
///
/// The [`mean`] of a map is the loss of the prediction over the same scenes on all texels, within the rounding of f32. A
/// scene is one step of `progress`.
///
/// # Errors
/// [`Error::UnusableScene`], [`Error::Cancelled`].
pub fn error_maps(
    comparison: &Comparison<'_, f32>,
    scenes: &[Scene],
    progress: &Progress,
) -> Result<Vec<Image<f32>>, Error> {
    let [width, height] = comparison.ground_truth().size();
    let convention = comparison.convention();
    let mut sums = vec![vec![[0.0_f64; 3]; width * height]; comparison.predictions().len()];
    let materials: Vec<_> =
        [comparison.ground_truth()].into_iter().chain(comparison.predictions().iter().copied()).collect();
    progress.begin(scenes.len() as u64);
    for scene in scenes {
        let render = |material: &&_| render::render_f32(material, scene, convention, &progress.part());
        let pictures = materials.iter().map(render).collect::<Result<Vec<_>, _>>()?;
        let maps = render::log_differences(&pictures, convention.epsilon as f32);
        for (sum, map) in sums.iter_mut().zip(&maps) {
            sum.par_iter_mut().zip(&map.pixels).for_each(|(sum, pixel)| {
                for (sum, value) in sum.iter_mut().zip(pixel) {
                    *sum += f64::from(*value);
                }
            });
        }
        progress.step()?;
    }
    let count = scenes.len() as f64;
    let image = |sum: Vec<[f64; 3]>| {
        let pixels = sum.into_par_iter().map(|sum| sum.map(|channel| (channel / count) as f32)).collect();
        Image { width, height, pixels }
    };
    Ok(sums.into_iter().map(image).collect())
}

/// The mean over texels and channels.
pub fn mean(image: &Image<f32>) -> f64 {
    let values = image.pixels.as_flattened();
    values.iter().map(|&value| f64::from(value)).sum::<f64>() / values.len() as f64
}
