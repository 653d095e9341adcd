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

/// What metrics of maps are of, in the order of the pairs that are compared.
#[derive(Clone, Copy)]
enum Of {
    NormalUnit,
    NormalStored,
    Diffuse,
    DiffuseSrgb,
    Specular,
    SpecularSrgb,
    Roughness,
    Alpha,
    Base,
    BaseScaled,
    BaseSrgb,
    Metallic,
    Packed,
    All,
}

/// The rows of metrics.
macro_rules! rows {
    ($($of:ident $($begin:literal $measure:ident),+ => $end:literal;)+) => {
        &[$($((Of::$of, concat!($begin, $end), $measure)),+),+]
    };
}

/// What a metric is of, its name, and how it is computed.
type Row<F> = (Of, &'static str, F);
type Measure = fn(&[[f64; 2]]) -> f64;
type Similarity = fn(&[[f64; 2]], [usize; 2]) -> Option<f64>;

/// Metrics of pairs of values.
#[rustfmt::skip]
const MEASURES: &[Row<Measure>] = rows! {
    NormalUnit "rmse" rmse => "_normal_unit";
    NormalStored "rmse" rmse, "l1" l1, "psnr" peak_ratio => "_normal_stored";
    Diffuse "rmse" rmse, "l1" l1, "psnr" peak_ratio => "_diffuse_linear";
    Diffuse "rmse" rmse_scaled => "_diffuse_linear_scaled";
    Diffuse "rmse" rmse_stretched => "_diffuse_linear_minus1_to_1";
    DiffuseSrgb "rmse" rmse, "l1" l1, "psnr" peak_ratio => "_diffuse_srgb";
    DiffuseSrgb "rmse" rmse_stretched => "_diffuse_srgb_minus1_to_1";
    Specular "rmse" rmse, "l1" l1, "psnr" peak_ratio => "_specular_linear";
    Specular "rmse" rmse_scaled => "_specular_linear_scaled";
    Specular "rmse" rmse_stretched => "_specular_linear_minus1_to_1";
    SpecularSrgb "rmse" rmse, "l1" l1, "psnr" peak_ratio => "_specular_srgb";
    SpecularSrgb "rmse" rmse_stretched => "_specular_srgb_minus1_to_1";
    Roughness "rmse" rmse, "l1" l1, "psnr" peak_ratio => "_roughness";
    Roughness "rmse" rmse_stretched => "_roughness_minus1_to_1";
    Alpha "rmse" rmse => "_roughness_alpha";
    Base "rmse" rmse => "_base_colour_linear";
    BaseScaled "psnr" peak_ratio => "_base_colour_linear_scaled_channels";
    BaseSrgb "rmse" rmse, "l1" l1, "psnr" peak_ratio => "_base_colour_srgb";
    Metallic "rmse" rmse, "l1" l1, "psnr" peak_ratio => "_metallic";
    Packed "psnr" peak_ratio => "_roughness_metallic_0_srgb";
    All "l1" l1_stretched => "_maps_minus1_to_1";
};

/// Metrics of pairs of values on a grid of (width, height) texels.
#[rustfmt::skip]
const SIMILARITIES: &[Row<Similarity>] = rows! {
    NormalStored "ssim11_gaussian" ssim11, "ssim7_uniform" ssim7 => "_normal_stored";
    DiffuseSrgb "ssim11_gaussian" ssim11, "ssim7_uniform" ssim7 => "_diffuse_srgb";
    SpecularSrgb "ssim11_gaussian" ssim11, "ssim7_uniform" ssim7 => "_specular_srgb";
    Roughness "ssim11_gaussian" ssim11, "ssim7_uniform" ssim7 => "_roughness";
    BaseSrgb "ssim11_gaussian" ssim11, "ssim7_uniform" ssim7 => "_base_colour_srgb";
    BaseScaled "ssim11_gaussian" ssim11 => "_base_colour_linear_scaled_channels";
    Metallic "ssim11_gaussian" ssim11, "ssim7_uniform" ssim7 => "_metallic";
    Packed "ssim11_gaussian" ssim11 => "_roughness_metallic_0_srgb";
};

/// The names of all metrics of maps.
pub(super) fn names() -> impl Iterator<Item = &'static str> {
    let angles = ["angle_normal_mean_degrees", "angle_normal_median_degrees", "angle_normal_p95_degrees"];
    let measures = MEASURES.iter().map(|(_, name, _)| *name);
    angles.into_iter().chain(measures).chain(SIMILARITIES.iter().map(|(_, name, _)| *name))
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
    // In the order of `Of`.
    let all = [
        normal,
        normal_stored,
        diffuse,
        diffuse_srgb,
        specular,
        specular_srgb,
        roughness,
        alpha,
        base,
        base_scaled,
        base_srgb,
        metallic,
        packed,
        all,
    ];
    let size = ground_truth.size();
    let similar = SIMILARITIES
        .iter()
        .filter_map(|(of, name, measure)| Some(Metric::exact(name, measure(&all[*of as usize], size)?)));
    let similar: Vec<Metric> = similar.collect();
    let all = match mask.filter(|mask| !mask.count_all) {
        Some(mask) => all.map(|pairs| counted(&pairs, mask.texels)),
        None => all,
    };
    let measured =
        MEASURES.iter().map(|(of, name, measure)| Metric::exact(name, measure(&all[*of as usize])));
    Ok(of_angles(angles(ground_truth, prediction, kept)).into_iter().chain(measured).chain(similar).collect())
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
