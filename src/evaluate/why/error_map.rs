//! Error map: the loss of each texel, its mean over all scenes.

use svbrdf_core::error::Error;
use svbrdf_core::image::Image;
use svbrdf_core::loss::{Comparison, Fused};
use svbrdf_core::model::scene::Scene;
use svbrdf_core::progress::Progress;

/// For each prediction the mean over `scenes` of |ln(R_gt + epsilon) - ln(R_pred + epsilon)| of every texel and channel, or what else
/// the norm of the convention takes the mean of.
///
/// The [`mean`] of a map is the loss of the prediction over the same scenes on all texels, within the rounding of f32. A
/// block of texels is one step of `progress`. The maps do not depend on the number of threads.
///
/// # Errors
/// [`Error::UnusableScene`], [`Error::Cancelled`]; [`Error::NotComputed`] for a norm that is no mean over texels.
pub fn error_maps(
    comparison: &Comparison<'_, f32>,
    scenes: &[Scene],
    progress: &Progress,
) -> Result<Vec<Image<f32>>, Error> {
    scenes.iter().try_for_each(Scene::check_usable)?;
    let [width, height] = comparison.ground_truth().size();
    let means = Fused::default().texel_means(comparison, scenes, progress)?;
    Ok(means.into_iter().map(|pixels| Image { width, height, pixels }).collect())
}

/// The mean over texels and channels.
pub fn mean(image: &Image<f32>) -> f64 {
    let values = image.pixels.as_flattened();
    values.iter().map(|&value| f64::from(value)).sum::<f64>() / values.len() as f64
}
