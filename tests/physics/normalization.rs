//! The microfacet distribution D is normalized: the integral of D(n.h) (n.h) over the hemisphere of h is 1.

use glam::DVec3;

use crate::support::tolerance::{NORMALIZATION_F32, NORMALIZATION_F64, NORMALIZATION_FUSED};
use svbrdf_core::material::Material;
use svbrdf_core::math::real::{Real, Vec3, Vector as _};
use svbrdf_core::model::brdf::{self, Model, Texel};
use svbrdf_core::model::convention::{Convention, GUIDED_2020, PRINTED};
use svbrdf_core::model::scene::{Kind, Scene};
use svbrdf_core::progress::Progress;
use svbrdf_core::render::simd::{Level, render_at};

/// From the roughest surface to the floor of `printed`.
pub const ROUGHNESS: [f64; 9] = [1.0, 0.7, 0.5, 0.2, 0.1, 0.03, 0.01, 1e-3, 1e-4];

/// Step of the logarithm of tan(theta). The trapezoid rule converges exponentially on this integrand.
const STEP: f64 = 0.25;
/// The integrand falls as the square of exp(-|ln tan(theta) - its centre|): beyond this, below 1e-8 of its maximum.
const REACH: f64 = 10.0;

/// Half vectors in a plane through the normal z, and the weights with which they sum D to its integral.
///
/// With u = ln tan(theta), the measure cos(theta) dh is 2 pi sin^2(theta) cos^2(theta) du.
fn nodes(roughness: f64) -> Vec<(DVec3, f64)> {
    let width = (roughness * roughness).ln();
    let count = ((2.0 * REACH - width) / STEP).ceil() as usize;
    let node = |i: usize| {
        let t = (width - REACH + STEP * i as f64).exp();
        let cosine = 1.0 / t.hypot(1.0);
        let sine = t * cosine;
        (DVec3::new(sine, 0.0, cosine), STEP * std::f64::consts::TAU * (sine * cosine).powi(2))
    };
    (0..count).map(node).collect()
}

fn integral(roughness: f64, d: impl Fn(DVec3) -> f64) -> f64 {
    nodes(roughness).into_iter().map(|(h, weight)| weight * d(h)).sum()
}

/// The largest distance of an integral from 1, over all roughnesses.
fn worst(d: impl Fn(f64, DVec3) -> f64) -> f64 {
    let all = ROUGHNESS.into_iter();
    let off = all.map(|r| (integral(r, |h| d(r, h)) - 1.0).abs());
    off.fold(0.0, |worst, off| if off.is_nan() { f64::INFINITY } else { worst.max(off) })
}

fn on_cpu<T: Real>(convention: &Convention, roughness: f64, h: DVec3) -> f64 {
    let a = T::of(roughness) * T::of(roughness);
    let n: Vec3<T> = DVec3::Z.cast();
    brdf::distribution(&Model::from(convention), n, h.cast(), a).f64()
}

/// The texel whose reflectance at l = v = h is G D / 4: F is 1, and nothing is diffuse.
fn white(roughness: f64) -> Texel<f32> {
    let roughness = roughness as f32;
    Texel { normal: glam::Vec3::Z, diffuse: [0.0; 3], specular: [1.0; 3], roughness }
}

/// D from the radiance of [`white`] under `printed` at l = v = h.
fn d_of(radiance: f32, roughness: f64, h: DVec3) -> f64 {
    let k = 0.5 * roughness * roughness;
    let g = 1.0 / (h.z * (1.0 - k) + k);
    4.0 * f64::from(radiance) / (g * g)
}

fn fused(level: Level, roughness: f64, h: DVec3) -> f64 {
    let material = Material::uniform("white", 1, 1, &white(roughness)).unwrap();
    let scene = Scene { kind: Kind::Distant, view: h.to_array(), light: h.to_array() };
    let image = render_at(level, &material, &scene, &PRINTED, &Progress::default()).unwrap();
    d_of(image.pixels[0][0], roughness, h)
}

#[test]
fn the_distribution_integrates_to_1_in_f64_and_f32() {
    let f64s = worst(|r, h| on_cpu::<f64>(&PRINTED, r, h));
    let f32s = worst(|r, h| on_cpu::<f32>(&PRINTED, r, h));
    println!("D: off by {f64s:.1e} in f64, {f32s:.1e} in f32");
    assert!(f64s <= NORMALIZATION_F64 && f32s <= NORMALIZATION_F32);
}

#[test]
fn the_distribution_integrates_to_1_in_the_fused_kernel() {
    for (name, level) in Level::all() {
        let Some(level) = level else { continue };
        let off = worst(|r, h| fused(level, r, h));
        println!("D fused, {name}: off by {off:.1e}");
        assert!(off <= NORMALIZATION_FUSED, "{name}: {off:e}");
    }
}

#[cfg(feature = "viewer")]
#[svbrdf_needs::needs(adapter)]
#[test]
fn the_distribution_integrates_to_1_on_the_gpu() {
    use crate::support::tolerance::NORMALIZATION_GPU;

    let gpu = crate::support::gpu::gpu();
    let integral = |r: f64| {
        let nodes = nodes(r);
        let w = |h: &DVec3| h.as_vec3().to_array();
        let points: Vec<_> = nodes.iter().map(|(h, _)| (white(r), w(h), w(h))).collect();
        let radiances = gpu.probe(&Model::from(&PRINTED), &points).unwrap();
        let terms = nodes.iter().zip(radiances).map(|((h, weight), [red, ..])| weight * d_of(red, r, *h));
        terms.sum::<f64>()
    };
    for r in ROUGHNESS {
        let off = (integral(r) - 1.0).abs();
        println!("D on the GPU, r = {r}: off by {off:.1e}");
        assert!(off <= NORMALIZATION_GPU, "r = {r}: {off:e}");
    }
}

#[test]
fn a_wrong_factor_of_the_distribution_and_a_floor_are_seen() {
    let scaled = |factor: f64| worst(|r, h| factor * on_cpu::<f64>(&PRINTED, r, h));
    assert!(scaled(1.0) <= NORMALIZATION_F64);
    assert!(scaled(1.0 + 2e-5) > NORMALIZATION_F64, "a factor slightly off");
    assert!(scaled(std::f64::consts::PI) > NORMALIZATION_FUSED, "pi left out");
    assert!(worst(|r, h| on_cpu::<f64>(&GUIDED_2020, r, h)) > NORMALIZATION_FUSED, "a floor");
    // A wrong width is none of these faults: D of any width is normalized.
    let grazing = |r: f64, h: DVec3| if h.z < 0.1 { 0.0 } else { on_cpu::<f64>(&PRINTED, r, h) };
    assert!(worst(grazing) > NORMALIZATION_F64, "nothing at grazing angles");
}
