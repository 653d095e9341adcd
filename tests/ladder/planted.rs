//! Defects that a rung might have, shown to the comparator of points.

use glam::DVec3;

use super::cases::{self, Batch, row, turned};
use super::rungs::{self, Rgb, Rung};
use super::survey::Survey;
use super::truth::{Region, Truth};
use svbrdf_core::model::brdf::Texel;
use svbrdf_core::model::convention::{GUIDED_2020, PRINTED};
use svbrdf_core::render::simd::Level;

/// Random batches that the kernel accepts.
fn batches() -> Vec<Batch> {
    (0..80).map(cases::random).filter(|b| b.w_l.z > 0.0 && b.w_v.z > 0.0).collect()
}

/// Those of `printed`.
fn printed() -> Vec<Batch> {
    batches().into_iter().filter(|b| b.convention == PRINTED).collect()
}

/// Peaks of mirrors where light, view and normals are nearly z. Their lengths are off by half an ulp of z, their x and
/// y by far less: well-conditioned, although the lobes are as narrow as an ulp of z.
fn peaks_near_z() -> Vec<Batch> {
    let batch = |i: u32| {
        let l = turned(DVec3::Z, 1e-4 * f64::from(i), f64::from(i));
        let texel = |j: i32| Texel {
            normal: turned(l, 10f64.powf(-7.0 + 0.05 * f64::from(j)), f64::from(j)).as_vec3(),
            diffuse: [0.5; 3],
            specular: [0.5; 3],
            roughness: 0.0,
        };
        let material = row(&(0..20).map(texel).collect::<Vec<_>>());
        Batch { convention: PRINTED, near: false, material, w_l: l.as_vec3(), w_v: l.as_vec3() }
    };
    (1..40).map(batch).collect()
}

/// The same light and view over changed texels.
fn with_texels(batch: &Batch, change: impl Fn(Texel<f32>) -> Texel<f32>) -> Batch {
    Batch { material: row(&batch.texels().map(change).collect::<Vec<_>>()), ..batch.clone() }
}

/// What the comparator says of `rung` where it gives `values`.
fn held(rung: Rung, batches: &[Batch], values: impl Fn(&Batch) -> Vec<Rgb>) -> Result<(), String> {
    let mut survey = Survey::new();
    for batch in batches {
        survey.hold(rung, "planted", batch, &Truth::of(batch), &values(batch));
    }
    survey.verdict()
}

fn scaled(values: Vec<Rgb>, factor: f64) -> Vec<Rgb> {
    values.into_iter().map(|rgb| rgb.map(|x| x * factor)).collect()
}

/// A change of the values of a batch, at a texel that is lit.
type Change = fn(&mut Vec<Rgb>, usize);

/// Faults that no rung may have.
const FAULTS: [(&str, Change); 8] = [
    ("NaN", |v, at| v[at][1] = f64::NAN),
    ("infinity", |v, at| v[at][1] = f64::INFINITY),
    ("a swapped sign", |v, at| v[at] = v[at].map(|x| -x)),
    ("negative, though within the bound", |v, at| v[at][2] = -1e-30),
    ("channels in another order", |v, at| v[at].rotate_left(1)),
    ("texels swapped", |v, at| v.swap(at, at + 1)),
    ("a little too bright", |v, at| v[at] = v[at].map(|x| x * 1.002)),
    ("a factor of 1/4 that is 0.26", |v, _| v.iter_mut().flatten().for_each(|x| *x *= 1.04)),
];

/// Whether the comparator sees [`FAULTS`] of a rung, and none where there is none.
fn sees_faults(rung: Rung, values: impl Fn(&Batch) -> Vec<Rgb>) {
    let batches = batches();
    held(rung, &batches, &values).unwrap_or_else(|e| panic!("without a fault: {e}"));
    let lit = Truth::of(&batches[0]).iter().position(|t| t.region.contains(&Region::Satin)).unwrap();
    for (name, change) in FAULTS {
        let faulty = |batch: &Batch| {
            let mut values = values(batch);
            change(&mut values, lit);
            values
        };
        held(rung, &batches[..1], faulty).expect_err(name);
    }
}

#[test]
fn defects_of_f64_are_seen() {
    sees_faults(Rung::F64, rungs::with_256_bits);
    let batches = batches();
    let off = |factor| held(Rung::F64, &batches, |b: &Batch| scaled(rungs::with_256_bits(b), factor));
    off(f64::from(std::f32::consts::FRAC_1_PI) / std::f64::consts::FRAC_1_PI).expect_err("1 / pi in f32");
    off(1.0 + 1e-12).expect_err("the last digits");
    let released = |b: &Batch| rungs::with_256_bits(&Batch { convention: GUIDED_2020, ..b.clone() });
    held(Rung::F64, &batches, released).expect_err("another convention");
}

#[test]
fn defects_of_f32_are_seen() {
    sees_faults(Rung::F32, rungs::in_f32);
    held(Rung::F32, &printed(), rungs::cancelling).expect_err("the cancelling form of D");
    let swapped = |b: &Batch| rungs::in_f32(&Batch { w_l: b.w_v, w_v: b.w_l, ..b.clone() });
    held(Rung::F32, &batches(), swapped).expect_err("light and view swapped");
}

#[test]
fn defects_of_the_kernel_are_seen() {
    let (best, batches, peaks) = (Level::best(), batches(), peaks_near_z());
    for (name, level) in rungs::levels() {
        sees_faults(Rung::Simd, |b| rungs::simd(level, b).unwrap());
        held(Rung::Simd, &peaks, |b| rungs::simd(level, b).unwrap()).expect(name);
    }
    held(Rung::Simd, &peaks, rungs::projecting).expect_err("no cross product");
    // What a reciprocal without its Newton step is off by.
    let estimate = 1.0 + 1.5 / f64::from(1 << 12);
    held(Rung::Simd, &batches, |b| scaled(rungs::simd(best, b).unwrap(), estimate))
        .expect_err("a Newton step is missing");
    let floor = |t: Texel<f32>| Texel { roughness: t.roughness.max(1.0 / 255.0), ..t };
    held(Rung::Simd, &batches, |b| rungs::simd(best, &with_texels(b, floor)).unwrap())
        .expect_err("another floor of the roughness");
}

#[cfg(feature = "viewer")]
#[svbrdf_needs::needs(f32_adapter)]
fn defects_of_the_shader_are_seen() {
    use exr::prelude::f16;

    let on_gpu = |b: &Batch| rungs::on_gpu(std::slice::from_ref(b)).unwrap().remove(0);
    sees_faults(Rung::Wgsl, on_gpu);
    let coarse =
        |t: Texel<f32>| Texel { normal: t.normal.to_array().map(|x| f16::from_f32(x).to_f32()).into(), ..t };
    held(Rung::Wgsl, &batches(), |b| on_gpu(&with_texels(b, coarse))).expect_err("normals in half floats");
}
