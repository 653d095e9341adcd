//! Metrics of the four maps, and of base colour and metallic, texel by texel.

use super::ssim::{ssim7, ssim11};
use super::{Metric, psnr};
use svbrdf_core::error::Error;
use svbrdf_core::loss::check_same_size;
use svbrdf_core::material::{Material, base_and_metallic};
use svbrdf_core::math::real::Real;
use svbrdf_core::math::srgb;
use svbrdf_core::statistics::quantile;

/// Values of the ground truth and of the prediction, all of one channel before the next.
type Pairs = Vec<[f64; 2]>;

/// Metrics of such pairs of values, by name.
type Measures = &'static [(&'static str, fn(&[[f64; 2]]) -> f64)];
/// Metrics of such pairs on a grid of (width, height) texels, by name.
type Similarities = &'static [(&'static str, fn(&[[f64; 2]], [usize; 2]) -> Option<f64>)];

const NORMAL_UNIT: Measures = &[("rmse_normal_unit", rmse)];
const NORMAL_STORED: Measures =
    &[("rmse_normal_stored", rmse), ("l1_normal_stored", l1), ("psnr_normal_stored", peak_ratio)];
const DIFFUSE_LINEAR: Measures = &[
    ("rmse_diffuse_linear", rmse),
    ("l1_diffuse_linear", l1),
    ("psnr_diffuse_linear", peak_ratio),
    ("rmse_diffuse_linear_scaled", rmse_scaled),
    ("rmse_diffuse_linear_minus1_to_1", rmse_stretched),
];
const DIFFUSE_SRGB: Measures = &[
    ("rmse_diffuse_srgb", rmse),
    ("l1_diffuse_srgb", l1),
    ("psnr_diffuse_srgb", peak_ratio),
    ("rmse_diffuse_srgb_minus1_to_1", rmse_stretched),
];
const SPECULAR_LINEAR: Measures = &[
    ("rmse_specular_linear", rmse),
    ("l1_specular_linear", l1),
    ("psnr_specular_linear", peak_ratio),
    ("rmse_specular_linear_scaled", rmse_scaled),
    ("rmse_specular_linear_minus1_to_1", rmse_stretched),
];
const SPECULAR_SRGB: Measures = &[
    ("rmse_specular_srgb", rmse),
    ("l1_specular_srgb", l1),
    ("psnr_specular_srgb", peak_ratio),
    ("rmse_specular_srgb_minus1_to_1", rmse_stretched),
];
const ROUGHNESS: Measures = &[
    ("rmse_roughness", rmse),
    ("l1_roughness", l1),
    ("psnr_roughness", peak_ratio),
    ("rmse_roughness_minus1_to_1", rmse_stretched),
];
const ROUGHNESS_ALPHA: Measures = &[("rmse_roughness_alpha", rmse)];
const BASE_LINEAR: Measures = &[("rmse_base_colour_linear", rmse)];
const BASE_SCALED: Measures = &[("psnr_base_colour_linear_scaled_channels", peak_ratio)];
const BASE_SRGB: Measures =
    &[("rmse_base_colour_srgb", rmse), ("l1_base_colour_srgb", l1), ("psnr_base_colour_srgb", peak_ratio)];
const METALLIC: Measures = &[("rmse_metallic", rmse), ("l1_metallic", l1), ("psnr_metallic", peak_ratio)];
const PACKED: Measures = &[("psnr_roughness_metallic_0_srgb", peak_ratio)];
const ALL_MAPS: Measures = &[("l1_maps_minus1_to_1", l1_stretched)];

const NORMAL_SIMILARITY: Similarities =
    &[("ssim11_gaussian_normal_stored", ssim11), ("ssim7_uniform_normal_stored", ssim7)];
const DIFFUSE_SIMILARITY: Similarities =
    &[("ssim11_gaussian_diffuse_srgb", ssim11), ("ssim7_uniform_diffuse_srgb", ssim7)];
const SPECULAR_SIMILARITY: Similarities =
    &[("ssim11_gaussian_specular_srgb", ssim11), ("ssim7_uniform_specular_srgb", ssim7)];
const ROUGHNESS_SIMILARITY: Similarities =
    &[("ssim11_gaussian_roughness", ssim11), ("ssim7_uniform_roughness", ssim7)];
const BASE_SIMILARITY: Similarities =
    &[("ssim11_gaussian_base_colour_srgb", ssim11), ("ssim7_uniform_base_colour_srgb", ssim7)];
const SCALED_SIMILARITY: Similarities = &[("ssim11_gaussian_base_colour_linear_scaled_channels", ssim11)];
const METALLIC_SIMILARITY: Similarities =
    &[("ssim11_gaussian_metallic", ssim11), ("ssim7_uniform_metallic", ssim7)];
const PACKED_SIMILARITY: Similarities = &[("ssim11_gaussian_roughness_metallic_0_srgb", ssim11)];

/// The names of all metrics of maps.
pub(super) fn names() -> impl Iterator<Item = &'static str> {
    const ANGLES: [&str; 3] =
        ["angle_normal_mean_degrees", "angle_normal_median_degrees", "angle_normal_p95_degrees"];
    let measures = [
        NORMAL_UNIT,
        NORMAL_STORED,
        DIFFUSE_LINEAR,
        DIFFUSE_SRGB,
        SPECULAR_LINEAR,
        SPECULAR_SRGB,
        ROUGHNESS,
        ROUGHNESS_ALPHA,
        BASE_LINEAR,
        BASE_SCALED,
        BASE_SRGB,
        METALLIC,
        PACKED,
        ALL_MAPS,
    ];
    let similarities = [
        NORMAL_SIMILARITY,
        DIFFUSE_SIMILARITY,
        SPECULAR_SIMILARITY,
        ROUGHNESS_SIMILARITY,
        BASE_SIMILARITY,
        SCALED_SIMILARITY,
        METALLIC_SIMILARITY,
        PACKED_SIMILARITY,
    ];
    let measures = measures.into_iter().flatten().map(|(name, _)| *name);
    ANGLES.into_iter().chain(measures).chain(similarities.into_iter().flatten().map(|(name, _)| *name))
}

/// The metrics of the maps of `prediction` against `ground_truth`, computed in f64; SSIM where a window lies inside.
///
/// # Errors
/// [`Error::SizesDiffer`].
pub fn of_maps<T: Real>(ground_truth: &Material<T>, prediction: &Material<T>) -> Result<Vec<Metric>, Error> {
    of_masked_maps(ground_truth, prediction, None)
}

/// The texels that a mask keeps. The others are black in both materials.
#[derive(Clone, Copy, Debug)]
pub struct Kept<'a> {
    /// Whether each is.
    pub texels: &'a [bool],
    /// Whether the others count, too, for other metrics than SSIM.
    pub count_all: bool,
}

/// [`of_maps`] of the texels that a mask keeps.
///
/// # Errors
/// [`Error::SizesDiffer`].
pub fn of_masked_maps<T: Real>(
    ground_truth: &Material<T>,
    prediction: &Material<T>,
    mask: Option<Kept<'_>>,
) -> Result<Vec<Metric>, Error> {
    check_same_size(ground_truth, prediction)?;
    let kept = mask.map(|mask| mask.texels);
    let (truth, predicted) = (ground_truth.planes(), prediction.planes());
    let blackened = |pairs: Pairs| match kept {
        Some(kept) => blackened(&pairs, kept),
        None => pairs,
    };
    let of = |truth: &[Vec<T>], predicted: &[Vec<T>]| blackened(pairs(truth, predicted));
    let normal = of(&truth.normal, &predicted.normal);
    let normal_stored = blackened(stored(&normal));
    let [diffuse, specular] =
        [(&truth.diffuse, &predicted.diffuse), (&truth.specular, &predicted.specular)].map(|(a, b)| of(a, b));
    let roughness = of(std::slice::from_ref(&truth.roughness), std::slice::from_ref(&predicted.roughness));
    let alpha = mapped(&roughness, |r| r * r);
    let (base, metallic) = base_pairs(&diffuse, &specular);
    let [base, metallic] = [base, metallic].map(blackened);
    let [diffuse_srgb, specular_srgb, base_srgb] =
        [&diffuse, &specular, &base].map(|pairs| mapped(pairs, srgb::encode));
    let base_scaled = scaled_channels(&base);
    let zeros = vec![[0.0; 2]; metallic.len()];
    let packed = mapped(&[roughness.as_slice(), &metallic, &zeros].concat(), srgb::encode);
    let all = [normal_stored.as_slice(), &diffuse, &roughness, &specular].concat();
    let measured = [
        (NORMAL_UNIT, &normal),
        (NORMAL_STORED, &normal_stored),
        (DIFFUSE_LINEAR, &diffuse),
        (DIFFUSE_SRGB, &diffuse_srgb),
        (SPECULAR_LINEAR, &specular),
        (SPECULAR_SRGB, &specular_srgb),
        (ROUGHNESS, &roughness),
        (ROUGHNESS_ALPHA, &alpha),
        (BASE_LINEAR, &base),
        (BASE_SCALED, &base_scaled),
        (BASE_SRGB, &base_srgb),
        (METALLIC, &metallic),
        (PACKED, &packed),
        (ALL_MAPS, &all),
    ];
    let similar = [
        (NORMAL_SIMILARITY, &normal_stored),
        (DIFFUSE_SIMILARITY, &diffuse_srgb),
        (SPECULAR_SIMILARITY, &specular_srgb),
        (ROUGHNESS_SIMILARITY, &roughness),
        (BASE_SIMILARITY, &base_srgb),
        (SCALED_SIMILARITY, &base_scaled),
        (METALLIC_SIMILARITY, &metallic),
        (PACKED_SIMILARITY, &packed),
    ];
    let mut metrics = of_angles(angles(ground_truth, prediction, kept));
    let left_out = mask.filter(|mask| !mask.count_all).map(|mask| mask.texels);
    metrics.extend(measured.into_iter().flat_map(|(measures, pairs)| {
        let pairs = left_out.map_or_else(|| pairs.clone(), |kept| counted(pairs, kept));
        measures.iter().map(move |(name, measure)| Metric::exact(name, measure(&pairs)))
    }));
    let size = ground_truth.size();
    metrics.extend(similar.into_iter().flat_map(|(measures, pairs)| {
        measures.iter().filter_map(move |(name, measure)| Some(Metric::exact(name, measure(pairs, size)?)))
    }));
    Ok(metrics)
}

/// The pairs with black in both where texels are not kept.
fn blackened(pairs: &[[f64; 2]], kept: &[bool]) -> Pairs {
    let one = |(pair, kept): (&[f64; 2], &bool)| if *kept { *pair } else { [0.0; 2] };
    pairs.iter().zip(kept.iter().cycle()).map(one).collect()
}

/// The pairs of texels that are kept, channel after channel.
fn counted(pairs: &[[f64; 2]], kept: &[bool]) -> Pairs {
    pairs.iter().zip(kept.iter().cycle()).filter(|(_, kept)| **kept).map(|(pair, _)| *pair).collect()
}

/// All (ground truth, prediction) of the channels of a map.
pub(super) fn pairs<T: Real>(truth: &[Vec<T>], predicted: &[Vec<T>]) -> Pairs {
    let channels = truth.iter().flatten().zip(predicted.iter().flatten());
    channels.map(|(a, b)| [a.f64(), b.f64()]).collect()
}

fn mapped(pairs: &[[f64; 2]], encode: impl Fn(f64) -> f64) -> Pairs {
    pairs.iter().map(|pair| pair.map(&encode)).collect()
}

/// Components of normals as (n + 1) / 2.
pub(super) fn stored(pairs: &[[f64; 2]]) -> Pairs {
    mapped(pairs, |n| 0.5 * (n + 1.0))
}

/// Base colour and metallic of all texels.
fn base_pairs(diffuse: &[[f64; 2]], specular: &[[f64; 2]]) -> (Pairs, Pairs) {
    let texels = diffuse.len() / 3;
    let of = |side: usize| -> Vec<([f64; 3], f64)> {
        let at = |pairs: &[[f64; 2]], texel: usize| [0, 1, 2].map(|c| pairs[c * texels + texel][side]);
        (0..texels).map(|texel| base_and_metallic(at(diffuse, texel), at(specular, texel))).collect()
    };
    let both: Vec<_> = of(0).into_iter().zip(of(1)).collect();
    let channel = |c: usize| both.iter().map(move |((a, _), (b, _))| [a[c], b[c]]);
    ((0..3).flat_map(channel).collect(), both.iter().map(|((_, a), (_, b))| [*a, *b]).collect())
}

pub(super) fn rmse(pairs: &[[f64; 2]]) -> f64 {
    (pairs.iter().map(|[a, b]| (a - b).powi(2)).sum::<f64>() / pairs.len() as f64).sqrt()
}

/// The RMSE of values v as 2 v - 1.
fn rmse_stretched(pairs: &[[f64; 2]]) -> f64 {
    2.0 * rmse(pairs)
}

/// The RMSE of the prediction times the one factor for all channels that brings it closest (least squares).
fn rmse_scaled(pairs: &[[f64; 2]]) -> f64 {
    let factor = factor(pairs);
    rmse(&pairs.iter().map(|[a, b]| [*a, factor * b]).collect::<Pairs>())
}

/// Each channel of the prediction times the factor that brings it closest (least squares), clipped to [0, 1].
fn scaled_channels(pairs: &[[f64; 2]]) -> Pairs {
    let scaled = |channel: &[[f64; 2]]| -> Pairs {
        let factor = factor(channel);
        channel.iter().map(|[a, b]| [*a, (factor * b).clamp(0.0, 1.0)]).collect()
    };
    pairs.chunks((pairs.len() / 3).max(1)).flat_map(scaled).collect()
}

/// The factor on the prediction that brings it closest to the ground truth (least squares).
fn factor(pairs: &[[f64; 2]]) -> f64 {
    let square: f64 = pairs.iter().map(|[_, b]| b * b).sum();
    let product: f64 = pairs.iter().map(|[a, b]| a * b).sum();
    if square > 0.0 { product / square } else { 1.0 }
}

/// The mean absolute difference of values v as 2 v - 1.
fn l1_stretched(pairs: &[[f64; 2]]) -> f64 {
    2.0 * l1(pairs)
}

fn l1(pairs: &[[f64; 2]]) -> f64 {
    pairs.iter().map(|[a, b]| (a - b).abs()).sum::<f64>() / pairs.len() as f64
}

fn peak_ratio(pairs: &[[f64; 2]]) -> f64 {
    psnr(rmse(pairs))
}

/// The metrics of the angles between normals, in degrees.
fn of_angles(mut angles: Vec<f64>) -> Vec<Metric> {
    let mean = angles.iter().sum::<f64>() / angles.len() as f64;
    let mut quantile = |probability| quantile(&mut angles, probability).unwrap_or(f64::NAN);
    vec![
        Metric::exact("angle_normal_mean_degrees", mean),
        Metric::exact("angle_normal_median_degrees", quantile(0.5)),
        Metric::exact("angle_normal_p95_degrees", quantile(0.95)),
    ]
}

/// The angles between normals of the texels that are kept, in degrees, sorted.
fn angles<T: Real>(ground_truth: &Material<T>, prediction: &Material<T>, kept: Option<&[bool]>) -> Vec<f64> {
    let vector = |material: &Material<T>, i: usize| {
        glam::DVec3::from_array(material.planes().normal.each_ref().map(|plane| plane[i].f64()))
    };
    let angle = |i| {
        let [a, b] = [vector(ground_truth, i), vector(prediction, i)];
        // Exact for small angles, too, where the arc cosine is not.
        2.0 * (a - b).length().atan2((a + b).length()).to_degrees()
    };
    let is_kept = |i: &usize| kept.is_none_or(|kept| kept[*i]);
    let all = (0..ground_truth.width() * ground_truth.height()).filter(is_kept);
    let mut angles: Vec<f64> = all.map(angle).collect();
    angles.sort_by(f64::total_cmp);
    angles
}
