//! Metrics of renderings over scenes.

use super::Metric;
use super::maps::srgb;
use crate::error::Error;
use crate::loss::check_same_size;
use crate::material::Material;
use crate::model::convention::Convention;
use crate::model::scene::Scene;
use crate::progress::Progress;
use crate::render;

/// Squared differences of all scenes, in three encodings.
#[derive(Clone, Copy, Debug, Default)]
struct Sums {
    linear: f64,
    srgb: f64,
    gamma: f64,
    count: f64,
}

/// The metrics of the renderings of `prediction` and `ground_truth` under `scenes`, over all texels and RGB.
///
/// Radiance, with the convention's factor, is clipped to [0, 1] first. A scene is one step of `progress`.
///
/// # Errors
/// [`Error::SizesDiffer`], [`Error::UnusableScene`], [`Error::Cancelled`].
pub fn of_renderings(
    ground_truth: &Material<f32>,
    prediction: &Material<f32>,
    scenes: &[Scene],
    convention: &Convention,
    progress: &Progress,
) -> Result<Vec<Metric>, Error> {
    check_same_size(ground_truth, prediction)?;
    progress.begin(scenes.len() as u64);
    let mut sums = Sums::default();
    for scene in scenes {
        let render = |material| render::render_f32(material, scene, convention, &progress.part());
        let [truth, predicted] = [render(ground_truth)?, render(prediction)?];
        let values = truth.pixels.as_flattened().iter().zip(predicted.pixels.as_flattened());
        for (a, b) in values {
            let [a, b] = [a, b].map(|value| f64::from(*value).clamp(0.0, 1.0));
            sums.linear += (a - b).powi(2);
            sums.srgb += (srgb(a) - srgb(b)).powi(2);
            sums.gamma += (a.powf(1.0 / 2.2) - b.powf(1.0 / 2.2)).powi(2);
            sums.count += 1.0;
        }
        progress.step()?;
    }
    let [linear, srgb, gamma] = [sums.linear, sums.srgb, sums.gamma].map(|sum| (sum / sums.count).sqrt());
    let metric = |name, value| Metric { name, value };
    // Of a peak of 1.
    let psnr = |rmse: f64| -20.0 * rmse.log10();
    Ok(vec![
        metric("rmse_rendering_clipped_linear", linear),
        metric("rmse_rendering_clipped_srgb", srgb),
        metric("rmse_rendering_clipped_gamma2.2", gamma),
        metric("psnr_rendering_clipped_linear", psnr(linear)),
        metric("psnr_rendering_clipped_srgb", psnr(srgb)),
    ])
}
