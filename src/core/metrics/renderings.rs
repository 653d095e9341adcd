//! Metrics of renderings over scenes.

use rayon::prelude::*;

use super::Metric;
use super::ssim::ssim11;
use crate::error::Error;
use crate::image::Image;
use crate::loss::check_same_size;
use crate::material::Material;
use crate::math::srgb;
use crate::model::convention::Convention;
use crate::model::scene::Scene;
use crate::progress::Progress;
use crate::render;

/// Of one scene or the sum over several: mean squared differences in three encodings, and the SSIM where there is one.
#[derive(Clone, Copy, Debug, Default)]
struct Means {
    linear: f64,
    srgb: f64,
    gamma: f64,
    similarity: Option<f64>,
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
    let one = |scene: &Scene| -> Result<Means, Error> {
        let render = |material| render::render_f32(material, scene, convention, &progress.part());
        let means = means(&render(ground_truth)?, &render(prediction)?);
        progress.step().map(|()| means)
    };
    // Summed in the order of the scenes: the result does not depend on the number of threads.
    let of_scenes: Vec<Means> = scenes.par_iter().map(one).collect::<Result<_, _>>()?;
    let mean = |of: fn(&Means) -> f64| of_scenes.iter().map(of).sum::<f64>() / of_scenes.len() as f64;
    let [linear, srgb, gamma] = [mean(|m| m.linear), mean(|m| m.srgb), mean(|m| m.gamma)].map(f64::sqrt);
    let metric = |name, value| Metric { name, value };
    // Of a peak of 1.
    let psnr = |rmse: f64| -20.0 * rmse.log10();
    let mut metrics = vec![
        metric("rmse_rendering_clipped_linear", linear),
        metric("rmse_rendering_clipped_srgb", srgb),
        metric("rmse_rendering_clipped_gamma2.2", gamma),
        metric("psnr_rendering_clipped_linear", psnr(linear)),
        metric("psnr_rendering_clipped_srgb", psnr(srgb)),
    ];
    if of_scenes.iter().all(|means| means.similarity.is_some()) {
        let similarity = mean(|means| means.similarity.unwrap_or_default());
        metrics.push(metric("ssim11_gaussian_rendering_clipped_srgb", similarity));
    }
    Ok(metrics)
}

fn means(truth: &Image<f32>, predicted: &Image<f32>) -> Means {
    let count = truth.pixels.len();
    let mut means = Means::default();
    let mut encoded = vec![[0.0; 2]; 3 * count];
    for (index, (a, b)) in truth.pixels.iter().zip(&predicted.pixels).enumerate() {
        for c in 0..3 {
            let [a, b] = [a[c], b[c]].map(|value| f64::from(value).clamp(0.0, 1.0));
            let pair = [srgb::encode(a), srgb::encode(b)];
            encoded[c * count + index] = pair;
            means.linear += (a - b).powi(2);
            means.srgb += (pair[0] - pair[1]).powi(2);
            means.gamma += (a.powf(1.0 / 2.2) - b.powf(1.0 / 2.2)).powi(2);
        }
    }
    let [linear, srgb, gamma] = [means.linear, means.srgb, means.gamma].map(|sum| sum / encoded.len() as f64);
    Means { linear, srgb, gamma, similarity: ssim11(&encoded, [truth.width, truth.height]) }
}
