//! Implementations of Algorithm 3 at points: the rungs, and forms of D that are none.

use glam::Vec3;

use svbrdf_core::material::Material;
use svbrdf_core::model::brdf::{self, Model, Texel};
use svbrdf_core::model::convention::PRINTED;
use svbrdf_core::model::scene::{Kind, Scene};
use svbrdf_core::progress::Progress;
use svbrdf_core::render::simd::{Level, render_at};

use super::cases::{Batch, row};
use super::exact;

svbrdf_core::choices! {
    /// A column of the table; f64 is held against 256 bits, all others against f64.
    Rung, "rung":
    F64 = "f64",
    /// As it is written.
    F32 = "f32",
    /// The kernel, at the instruction set where it is worst.
    Simd = "SIMD",
    /// The shader of the window.
    Wgsl = "WGSL",
}

pub type Rgb = [f64; 3];

fn widened(values: impl IntoIterator<Item = [f32; 3]>) -> Vec<Rgb> {
    values.into_iter().map(|rgb| rgb.map(f64::from)).collect()
}

pub fn with_256_bits(batch: &Batch) -> Vec<Rgb> {
    batch.texels().map(|t| exact::radiance(&batch.convention, &t, batch.w_l, batch.w_v)).collect()
}

pub fn in_f32(batch: &Batch) -> Vec<Rgb> {
    let model = Model::from(&batch.convention);
    widened(batch.texels().map(|t| brdf::render(&model, &t, batch.w_l, batch.w_v)))
}

/// The instruction sets of this machine; says which ones it lacks.
pub fn levels() -> Vec<(&'static str, Level)> {
    static MISSING: std::sync::Once = std::sync::Once::new();
    let all = Level::all();
    MISSING.call_once(|| {
        let missing = all.iter().filter(|(_, level)| level.is_none());
        missing.for_each(|(name, _)| eprintln!("NOT TESTED: this machine has no {name}"));
    });
    all.into_iter().filter_map(|(name, level)| Some((name, level?))).collect()
}

fn scene(kind: Kind, batch: &Batch) -> Scene {
    let position = |w: Vec3| w.as_dvec3().to_array();
    Scene { kind, view: position(batch.w_v), light: position(batch.w_l) }
}

/// The kernel; `None` where light or view are not above the plane, which no scene may have.
pub fn simd(level: Level, batch: &Batch) -> Option<Vec<Rgb>> {
    let scene = scene(if batch.near { Kind::Near } else { Kind::Distant }, batch);
    scene.check().ok()?;
    let render = |material: &Material<f32>| {
        let image = render_at(level, material, &scene, &batch.convention, &Progress::default()).unwrap();
        widened(image.pixels)
    };
    // The only texel of a material lies at the origin.
    let single = |texel: Texel<f32>| render(&row(&[texel]))[0];
    Some(if batch.near { batch.texels().map(single).collect() } else { render(&batch.material) })
}

/// The shader under distant lights, for each batch; `None` where no adapter renders to 32-bit floats.
#[cfg(feature = "viewer")]
pub fn on_gpu(batches: &[Batch]) -> Option<Vec<Vec<Rgb>>> {
    use crate::support::gpu::{find_gpu, shaded};

    let gpu = find_gpu().ok().filter(|_| svbrdf_needs::has!(f32_adapter))?;
    let of = |batch: &Batch| {
        let pixels = shaded(gpu, &batch.material, &scene(Kind::Distant, batch), &batch.convention);
        widened(pixels.read_back(gpu).unwrap().pixels)
    };
    Some(batches.iter().map(of).collect())
}

#[cfg(not(feature = "viewer"))]
pub fn on_gpu(_: &[Batch]) -> Option<Vec<Vec<Rgb>>> {
    None
}

/// `printed` in f32, with |n x h|^2 + a^2 NoH^2, the denominator of D, computed by `denominator` from n, h, NoH and a.
fn with_denominator(batch: &Batch, denominator: impl Fn(Vec3, Vec3, f32, f32) -> f32) -> Vec<Rgb> {
    let model = Model::<f32>::from(&PRINTED);
    let (l, v) = (batch.w_l.normalize(), batch.w_v.normalize());
    let radiance = |t: Texel<f32>| {
        let n_dot_l = t.normal.dot(l);
        if n_dot_l <= 0.0 || l.z <= 0.0 {
            return [0.0; 3];
        }
        let h = brdf::half_vector(t.normal, l, v);
        let a = t.roughness.max(model.roughness_floor).powi(2);
        let ratio = a / denominator(t.normal, h, t.normal.dot(h), a);
        let factor = |cosine| brdf::geometry_factor(&model, cosine, 0.5 * a);
        let g = factor(n_dot_l) * factor(t.normal.dot(v).max(0.0));
        let lobe = g * std::f32::consts::FRAC_1_PI * ratio * ratio * 0.25;
        let weight = brdf::fresnel_weight(v.dot(h).clamp(0.0, 1.0));
        let e = brdf::irradiance(&model, n_dot_l, l.z);
        let channel = |s, d| (brdf::fresnel(s, weight) * lobe + brdf::lambert(d, s)) * e;
        [0, 1, 2].map(|c| channel(t.specular[c], t.diffuse[c]))
    };
    widened(batch.texels().map(radiance))
}

/// The denominator of D as it is printed, which cancels.
pub fn cancelling(batch: &Batch) -> Vec<Rgb> {
    with_denominator(batch, |_, _, n_dot_h, a| n_dot_h * n_dot_h * (a * a - 1.0) + 1.0)
}

/// The denominator of D from what is left of h without its part along n, as the fast path of the kernel computes it.
pub fn projecting(batch: &Batch) -> Vec<Rgb> {
    with_denominator(batch, |n, h, n_dot_h, a| (h - n * n_dot_h).length_squared() + (a * n_dot_h).powi(2))
}
