//! Metrics of the four maps, texel by texel.

use super::Metric;
use super::ssim::ssim11;
use crate::error::Error;
use crate::loss::check_same_size;
use crate::material::Material;
use crate::math::real::Real;
use crate::math::srgb;
use crate::statistics::quantile;

/// The metrics of the maps of `prediction` against `ground_truth`, computed in f64; SSIM from 11 x 11 texels on.
///
/// # Errors
/// [`Error::SizesDiffer`].
pub fn of_maps<T: Real>(ground_truth: &Material<T>, prediction: &Material<T>) -> Result<Vec<Metric>, Error> {
    check_same_size(ground_truth, prediction)?;
    let (truth, predicted) = (ground_truth.planes(), prediction.planes());
    let [diffuse, specular] = [(&truth.diffuse, &predicted.diffuse), (&truth.specular, &predicted.specular)]
        .map(|(a, b)| pairs(a, b));
    let normal = pairs(&truth.normal, &predicted.normal);
    let roughness = pairs(std::slice::from_ref(&truth.roughness), std::slice::from_ref(&predicted.roughness));
    let mut angles = angles(ground_truth, prediction);
    let mean_angle = angles.iter().sum::<f64>() / angles.len() as f64;
    let mut angle_quantile = |probability| quantile(&mut angles, probability).unwrap_or(f64::NAN);
    let stored = stored(&normal);
    let alpha = mapped(&roughness, |r| r * r);
    let [diffuse_srgb, specular_srgb] = [&diffuse, &specular].map(|pairs| mapped(pairs, srgb::encode));
    let metric = |name, value| Metric { name, value };
    let mut metrics = vec![
        metric("angle_normal_mean_degrees", mean_angle),
        metric("angle_normal_median_degrees", angle_quantile(0.5)),
        metric("angle_normal_p95_degrees", angle_quantile(0.95)),
        metric("rmse_normal_unit", rmse(&normal)),
        metric("rmse_normal_stored", rmse(&stored)),
        metric("l1_normal_stored", l1(&stored)),
        metric("rmse_diffuse_linear", rmse(&diffuse)),
        metric("l1_diffuse_linear", l1(&diffuse)),
        metric("rmse_diffuse_linear_scaled", rmse(&scaled(&diffuse))),
        metric("rmse_diffuse_srgb", rmse(&diffuse_srgb)),
        metric("l1_diffuse_srgb", l1(&diffuse_srgb)),
        metric("rmse_specular_linear", rmse(&specular)),
        metric("l1_specular_linear", l1(&specular)),
        metric("rmse_specular_linear_scaled", rmse(&scaled(&specular))),
        metric("rmse_specular_srgb", rmse(&specular_srgb)),
        metric("l1_specular_srgb", l1(&specular_srgb)),
        metric("rmse_roughness", rmse(&roughness)),
        metric("l1_roughness", l1(&roughness)),
        metric("rmse_roughness_alpha", rmse(&alpha)),
    ];
    let similarities = [
        ("ssim11_gaussian_normal_stored", &stored),
        ("ssim11_gaussian_diffuse_srgb", &diffuse_srgb),
        ("ssim11_gaussian_specular_srgb", &specular_srgb),
        ("ssim11_gaussian_roughness", &roughness),
    ];
    let size = ground_truth.size();
    metrics.extend(
        similarities.into_iter().filter_map(|(name, pairs)| Some(metric(name, ssim11(pairs, size)?))),
    );
    Ok(metrics)
}

/// All (ground truth, prediction) of the channels of a map.
pub(super) fn pairs<T: Real>(truth: &[Vec<T>], predicted: &[Vec<T>]) -> Vec<[f64; 2]> {
    let channels = truth.iter().flatten().zip(predicted.iter().flatten());
    channels.map(|(a, b)| [a.f64(), b.f64()]).collect()
}

fn mapped(pairs: &[[f64; 2]], encode: impl Fn(f64) -> f64) -> Vec<[f64; 2]> {
    pairs.iter().map(|pair| pair.map(&encode)).collect()
}

/// Components of normals as (n + 1) / 2.
pub(super) fn stored(pairs: &[[f64; 2]]) -> Vec<[f64; 2]> {
    mapped(pairs, |n| 0.5 * (n + 1.0))
}

/// The prediction times the one factor for all channels that brings it closest (least squares).
fn scaled(pairs: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let square: f64 = pairs.iter().map(|[_, b]| b * b).sum();
    let product: f64 = pairs.iter().map(|[a, b]| a * b).sum();
    let factor = if square > 0.0 { product / square } else { 1.0 };
    pairs.iter().map(|[a, b]| [*a, factor * b]).collect()
}

pub(super) fn rmse(pairs: &[[f64; 2]]) -> f64 {
    (pairs.iter().map(|[a, b]| (a - b).powi(2)).sum::<f64>() / pairs.len() as f64).sqrt()
}

fn l1(pairs: &[[f64; 2]]) -> f64 {
    pairs.iter().map(|[a, b]| (a - b).abs()).sum::<f64>() / pairs.len() as f64
}

/// The angles between normals in degrees, sorted.
fn angles<T: Real>(ground_truth: &Material<T>, prediction: &Material<T>) -> Vec<f64> {
    let vector = |material: &Material<T>, i: usize| {
        glam::DVec3::from_array(material.planes().normal.each_ref().map(|plane| plane[i].f64()))
    };
    let angle = |i| {
        let [a, b] = [vector(ground_truth, i), vector(prediction, i)];
        // Exact for small angles, too, where the arc cosine is not.
        2.0 * (a - b).length().atan2((a + b).length()).to_degrees()
    };
    let mut angles: Vec<f64> = (0..ground_truth.width() * ground_truth.height()).map(angle).collect();
    angles.sort_by(f64::total_cmp);
    angles
}
