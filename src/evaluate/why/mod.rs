//! Origins of a loss: maps, scenes and texels.
//!
//! ```
//! use svbrdf_core::loss::Request;
//! use svbrdf_core::material::{Map, Material};
//! use svbrdf_core::model::brdf::Texel;
//! use svbrdf_core::model::convention::Convention;
//! use svbrdf_core::progress::Progress;
//! use svbrdf_evaluate::why;
//!
//! let texel = |diffuse: f32, roughness: f32| Texel { normal: glam::Vec3::Z, diffuse: [diffuse; 3], specular: [0.04; 3], roughness };
//! let truth = Material::uniform("truth", 64, 64, &texel(0.5, 0.6))?;
//! let prediction = Material::uniform("too dark and too rough", 64, 64, &texel(0.45, 0.9))?;
//! let request = Request::Accuracy { target: 0.05, seed: 0 };
//! let blame = why::attribute(&truth, &prediction, &Convention::default(), &request, &Progress::default())?;
//! let share = |map| blame.of(map).shapley.mean / blame.loss.mean;
//! assert!(share(Map::Roughness) > 0.0 && share(Map::Diffuse) > 0.0 && share(Map::Normal) == 0.0);
//! assert!((Map::ALL.map(share).iter().sum::<f64>() - 1.0).abs() < 1e-9);
//! # Ok::<(), svbrdf_evaluate::Error>(())
//! ```

mod attribution;
mod cloud;
mod scene_losses;
mod worst;

pub use attribution::{Attribution, MOST_SCENES, MapShare, attribute, attribute_in};
pub use scene_losses::{Distribution, RankedScene, worst_first, worst_on_all_texels};
pub use worst::{TAIL, Worst, worst};

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
