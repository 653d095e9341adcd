//! Implementations that compute the cases: the ladder of precision and its references.

use glam::Vec3;

use svbrdf_core::material::Material;
use svbrdf_core::model::brdf::{self, Model, Texel};
use svbrdf_core::model::convention::{Convention, GUIDED_2020, PRINTED};
use svbrdf_core::model::scene::{Kind, Scene};
use svbrdf_core::progress::Progress;
use svbrdf_core::render::simd::{Level, render_at};

use super::cases::{Batch, row};
use super::exact;
use super::regions::in_f64;

/// A column of the table.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rung {
    /// f64, against 256 bits.
    F64,
    /// f32 on the CPU. This and all that follow: against f64.
    F32,
    /// The fused kernel, at the instruction set where it is worst.
    Fused,
    Gpu,
    /// f32 with the denominator of D as it is printed.
    Cancelling,
    /// The clamps of the released codes, in f64.
    Clamps,
}

impl Rung {
    pub const ALL: [Self; 6] = [Self::F64, Self::F32, Self::Fused, Self::Gpu, Self::Cancelling, Self::Clamps];

    pub fn name(self) -> &'static str {
        match self {
            Self::F64 => "f64",
            Self::F32 => "f32",
            Self::Fused => "fused f32",
            Self::Gpu => "GPU",
            Self::Cancelling => "cancelling D",
            Self::Clamps => "clamps",
        }
    }
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

/// The instruction sets of this machine.
pub fn levels() -> Vec<(&'static str, Level)> {
    Level::all().into_iter().filter_map(|(name, level)| Some((name, level?))).collect()
}

/// The fused kernel; `None` where light or view are not above the plane, which no scene may have.
pub fn fused(level: Level, batch: &Batch) -> Option<Vec<Rgb>> {
    let position = |w: Vec3| w.as_dvec3().to_array();
    let kind = if batch.near { Kind::Near } else { Kind::Distant };
    let scene = Scene { kind, view: position(batch.w_v), light: position(batch.w_l) };
    scene.check().ok()?;
    let render = |material: &Material<f32>| {
        let image = render_at(level, material, &scene, &batch.convention, &Progress::default()).unwrap();
        widened(image.pixels)
    };
    // The only texel of a material lies at the origin.
    let single = |texel: Texel<f32>| render(&row(&[texel]))[0];
    Some(if batch.near { batch.texels().map(single).collect() } else { render(&batch.material) })
}

/// The shader, for each batch; `None` where there is no adapter.
#[cfg(feature = "viewer")]
pub fn on_gpu(batches: &[Batch]) -> Option<Vec<Vec<Rgb>>> {
    use svbrdf_core::model::convention;

    let gpu = crate::support::gpu::find_gpu().ok()?;
    let mut values: Vec<_> = batches.iter().map(|_| Vec::new()).collect();
    for convention in &convention::ALL {
        let of_convention = || batches.iter().enumerate().filter(|(_, b)| b.convention == *convention);
        let points: Vec<_> = of_convention()
            .flat_map(|(_, b)| b.texels().map(|t| (t, b.w_l.to_array(), b.w_v.to_array())))
            .collect();
        let radiances = widened(gpu.probe(&Model::from(convention), &points).unwrap());
        let mut rest = radiances.as_slice();
        for (index, batch) in of_convention() {
            let (own, others) = rest.split_at(batch.len());
            values[index] = own.to_vec();
            rest = others;
        }
    }
    Some(values)
}

#[cfg(not(feature = "viewer"))]
pub fn on_gpu(_: &[Batch]) -> Option<Vec<Vec<Rgb>>> {
    None
}

/// `printed` in f32, with |n x h|^2 + a^2 NoH^2, the denominator of D, computed by `denominator` from n, h, NoH and a.
fn with_denominator(batch: &Batch, denominator: impl Fn(Vec3, Vec3, f32, f32) -> f32) -> Option<Vec<Rgb>> {
    let model = Model::<f32>::from(&PRINTED);
    let (l, v) = (batch.w_l.normalize(), batch.w_v.normalize());
    let radiance = |t: Texel<f32>| {
        let n_dot_l = t.normal.dot(l);
        if n_dot_l <= 0.0 || l.z <= 0.0 {
            return [0.0; 3];
        }
        let h = brdf::half_vector(t.normal, l, v);
        let (n_dot_h, v_dot_h) = (t.normal.dot(h), v.dot(h).clamp(0.0, 1.0));
        let n_dot_v = t.normal.dot(v).max(0.0);
        let a = t.roughness.max(model.roughness_floor).powi(2);
        let ratio = a / denominator(t.normal, h, n_dot_h, a);
        let d = std::f32::consts::FRAC_1_PI * (ratio * ratio);
        let factor = |cosine| brdf::geometry_factor(&model, cosine, 0.5 * a);
        let lobe = factor(n_dot_l) * factor(n_dot_v) * d * 0.25;
        let weight = brdf::fresnel_weight(v_dot_h);
        let e = brdf::irradiance(&model, n_dot_l, l.z);
        [0, 1, 2].map(|c| {
            let (s, d) = (t.specular[c], t.diffuse[c]);
            (brdf::fresnel(s, weight) * lobe + brdf::lambert(d, s)) * e
        })
    };
    (batch.convention == PRINTED).then(|| widened(batch.texels().map(radiance)))
}

/// The denominator of D as it is printed, which cancels; only for the convention `printed`.
pub fn cancelling(batch: &Batch) -> Option<Vec<Rgb>> {
    with_denominator(batch, |_, _, n_dot_h, a| n_dot_h * n_dot_h * (a * a - 1.0) + 1.0)
}

/// The denominator of D from what is left of h without its part along n, as the fast path of the fused kernel computes
/// it; only for the convention `printed`.
pub fn projecting(batch: &Batch) -> Option<Vec<Rgb>> {
    with_denominator(batch, |n, h, n_dot_h, a| (h - n * n_dot_h).length_squared() + (a * n_dot_h).powi(2))
}

/// What the clamps that the released codes share make of `printed`, without their factor on R.
pub fn clamped(batch: &Batch) -> Option<Vec<Rgb>> {
    let convention = Convention { intensity: 1.0, ..GUIDED_2020 };
    let model = Model::from(&convention);
    let radiance = |t| brdf::render(&model, &in_f64(&t), batch.w_l.as_dvec3(), batch.w_v.as_dvec3());
    (batch.convention == PRINTED).then(|| batch.texels().map(radiance).collect())
}
