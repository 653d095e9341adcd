//! Metrics of renderings over scenes.

use super::ssim::{ssim7, ssim11};
use super::{Metric, psnr};
use svbrdf_core::error::Error;
use svbrdf_core::image::Image;
use svbrdf_core::loss::{Estimate, check_same_size};
use svbrdf_core::material::Material;
use svbrdf_core::math::srgb;
use svbrdf_core::model::convention::Convention;
use svbrdf_core::model::sampler::Sampler;
use svbrdf_core::model::scene::Scene;
use svbrdf_core::parallel;
use svbrdf_core::picture::flip::mean_flip;
use svbrdf_core::progress::Progress;
use svbrdf_core::render;

/// The names of all metrics of renderings.
pub(super) const NAMES: [&str; 10] = [
    "rmse_rendering_clipped_linear",
    "rmse_rendering_clipped_srgb",
    "rmse_rendering_clipped_gamma2.2",
    "l1_rendering_clipped_linear",
    "l1_rendering_clipped_srgb",
    "psnr_rendering_clipped_linear",
    "psnr_rendering_clipped_srgb",
    "flip_rendering_clipped",
    "ssim11_gaussian_rendering_clipped_srgb",
    "ssim7_uniform_rendering_clipped_srgb",
];

/// What renderings are compared in.
#[derive(Clone, Copy, Debug)]
pub struct RenderedScenes<'a> {
    pub scenes: &'a [Scene],
    /// What the scenes were sampled by; independent ones of a list count as random.
    pub sampler: Sampler,
    pub convention: &'a Convention,
    /// Radiance is multiplied by 2^exposure_ev.
    pub exposure_ev: f32,
}

/// Of one scene: mean squared differences in three encodings, mean absolute ones in two, FLIP, and the SSIM where a window lies inside.
#[derive(Clone, Copy, Debug)]
struct Means {
    linear: f64,
    srgb: f64,
    gamma: f64,
    absolute: [f64; 2],
    flip: f64,
    ssim11: Option<f64>,
    ssim7: Option<f64>,
}

/// The metrics of the renderings of `prediction` and `ground_truth` in `rendered`, over all texels and RGB.
///
/// Radiance, with the convention's factor and the exposure, is clipped to [0, 1] first. Intervals are by
/// [`Estimate::of_sampled`], unknown for a single scene of a kind. A scene is one step of `progress`.
///
/// # Errors
/// [`Error::SizesDiffer`], [`Error::UnusableScene`], [`Error::Cancelled`].
pub fn of_renderings(
    ground_truth: &Material<f32>,
    prediction: &Material<f32>,
    rendered: &RenderedScenes<'_>,
    progress: &Progress,
) -> Result<Vec<Metric>, Error> {
    check_same_size(ground_truth, prediction)?;
    let RenderedScenes { scenes, convention, exposure_ev, .. } = *rendered;
    progress.begin(scenes.len() as u64);
    let one = |index: usize| -> Result<Means, Error> {
        let render = |material| render::render_f32(material, &scenes[index], convention, &progress.part());
        let means = means(&render(ground_truth)?, &render(prediction)?, exposure_ev);
        progress.step().map(|()| means)
    };
    // Summed in the order of the scenes: the result does not depend on the number of threads.
    Ok(rendered.metrics(&parallel::try_map(scenes.len(), one)?))
}

impl RenderedScenes<'_> {
    fn metrics(&self, means: &[Means]) -> Vec<Metric> {
        let known = |name, of: fn(&Means) -> f64| {
            let values: Vec<f64> = means.iter().map(of).collect();
            metric(name, Estimate::of_sampled(self.sampler, self.scenes, &values))
        };
        let [linear, srgb, gamma] = [
            known("rmse_rendering_clipped_linear", |means| means.linear),
            known("rmse_rendering_clipped_srgb", |means| means.srgb),
            known("rmse_rendering_clipped_gamma2.2", |means| means.gamma),
        ]
        .map(root);
        let mut metrics = vec![
            linear,
            srgb,
            gamma,
            known("l1_rendering_clipped_linear", |means| means.absolute[0]),
            known("l1_rendering_clipped_srgb", |means| means.absolute[1]),
            Metric::exact("psnr_rendering_clipped_linear", psnr(linear.value)),
            Metric::exact("psnr_rendering_clipped_srgb", psnr(srgb.value)),
            known("flip_rendering_clipped", |means| means.flip),
        ];
        let similarity = |name, of: fn(&Means) -> Option<f64>| {
            let values = means.iter().map(of).collect::<Option<Vec<f64>>>()?;
            Some(metric(name, Estimate::of_signed(self.sampler, self.scenes, &values)))
        };
        metrics.extend(similarity("ssim11_gaussian_rendering_clipped_srgb", |means| means.ssim11));
        metrics.extend(similarity("ssim7_uniform_rendering_clipped_srgb", |means| means.ssim7));
        metrics
    }
}

/// The mean over the scenes, with its interval.
fn metric(name: &'static str, estimate: Estimate) -> Metric {
    Metric { name, value: estimate.mean, interval95: estimate.interval95 }
}

/// The root of a mean square and of its interval.
fn root(square: Metric) -> Metric {
    let interval95 = square.interval95.map(|ends| ends.map(f64::sqrt));
    Metric { value: square.value.sqrt(), interval95, ..square }
}

fn means(truth: &Image<f32>, predicted: &Image<f32>, exposure_ev: f32) -> Means {
    let count = truth.pixels.len();
    let gain = f64::from(exposure_ev).exp2();
    let [mut linear, mut gamma, mut absolute] = [0.0; 3];
    let mut encoded = vec![[0.0; 2]; 3 * count];
    for (index, (a, b)) in truth.pixels.iter().zip(&predicted.pixels).enumerate() {
        for c in 0..3 {
            let [a, b] = [a[c], b[c]].map(|value| (gain * f64::from(value)).clamp(0.0, 1.0));
            encoded[c * count + index] = [srgb::encode(a), srgb::encode(b)];
            linear += (a - b).powi(2);
            absolute += (a - b).abs();
            gamma += (a.powf(1.0 / 2.2) - b.powf(1.0 / 2.2)).powi(2);
        }
    }
    let srgb: f64 = encoded.iter().map(|[a, b]| (a - b).powi(2)).sum();
    let of_encoded: f64 = encoded.iter().map(|[a, b]| (a - b).abs()).sum();
    let mean = |sum: f64| sum / encoded.len() as f64;
    let [linear, srgb, gamma] = [linear, srgb, gamma].map(mean);
    let absolute = [absolute, of_encoded].map(mean);
    let size = [truth.width, truth.height];
    let flip = mean_flip(truth, predicted, exposure_ev);
    let [ssim11, ssim7] = [ssim11(&encoded, size), ssim7(&encoded, size)];
    Means { linear, srgb, gamma, absolute, flip, ssim11, ssim7 }
}
