//! Defects that a rung might have, shown to its comparator.

use glam::DVec3;

use super::cases::{self, Batch, row, turned};
use super::regions::{Region, Truth};
use super::rungs::{self, Rgb, Rung};
use super::survey::Survey;
use svbrdf_core::material::Material;
use svbrdf_core::model::brdf::Texel;
use svbrdf_core::model::convention::{GUIDED_2020, PRINTED};
use svbrdf_core::render::simd::Level;

/// Random batches that the fused kernel accepts.
fn batches() -> Vec<Batch> {
    (0..80).map(cases::random).filter(|b| b.w_l.z > 0.0 && b.w_v.z > 0.0).collect()
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

/// The same light and view over other texels.
fn with_material(batch: &Batch, material: Material<f32>) -> Batch {
    Batch { material, ..*batch }
}

/// What the comparator says of `rung` where it gives `values`.
fn held(rung: Rung, batches: &[Batch], values: impl Fn(&Batch) -> Vec<Rgb>) -> Result<(), String> {
    let mut survey = Survey::new();
    for batch in batches {
        survey.hold(rung, "planted", batch, &Truth::of(batch), &values(batch));
    }
    survey.verdict()
}

/// Faults that no rung may have: one value is not a number, infinite, negative, or that of another channel or texel;
/// or one of a well-conditioned value is off by 0.2%.
fn held_to_sense(rung: Rung, values: impl Fn(&Batch) -> Vec<Rgb>) {
    let batches = batches();
    held(rung, &batches, &values).unwrap_or_else(|e| panic!("without a fault: {e}"));
    let one = &batches[..1];
    let lit = Truth::of(&one[0]).iter().position(|t| t.region.contains(&Region::Satin)).unwrap();
    let planted = |change: fn(&mut Vec<Rgb>, usize)| {
        held(rung, one, |batch| {
            let mut values = values(batch);
            change(&mut values, lit);
            values
        })
    };
    planted(|_, _| ()).expect("no fault");
    planted(|v, at| v[at][1] = f64::NAN).expect_err("NaN");
    planted(|v, at| v[at][1] = f64::INFINITY).expect_err("infinity");
    planted(|v, at| v[at][2] = -1e-30).expect_err("negative");
    planted(|v, at| v[at].rotate_left(1)).expect_err("channels in another order");
    planted(|v, at| v.swap(at, at + 1)).expect_err("texels swapped");
    planted(|v, at| v[at] = v[at].map(|x| x * 1.002)).expect_err("a little too bright");
}

#[test]
fn defects_of_f64_are_seen() {
    held_to_sense(Rung::F64, rungs::with_256_bits);
    let batches = batches();
    let off = |factor: f64| {
        let scaled = |b: &Batch| rungs::with_256_bits(b).iter().map(|v| v.map(|x| x * factor)).collect();
        held(Rung::F64, &batches, scaled)
    };
    off(f64::from(std::f32::consts::FRAC_1_PI) / std::f64::consts::FRAC_1_PI).expect_err("1 / pi in f32");
    off(1.0 + 1e-12).expect_err("the last digits");
    let released = |b: &Batch| {
        rungs::with_256_bits(&Batch { convention: GUIDED_2020, ..with_material(b, b.material.clone()) })
    };
    held(Rung::F64, &batches, released).expect_err("another convention");
}

#[test]
fn defects_of_f32_are_seen() {
    held_to_sense(Rung::F32, rungs::in_f32);
    let mut batches = batches();
    batches.retain(|b| b.convention == PRINTED);
    held(Rung::F32, &batches, |b| rungs::cancelling(b).unwrap()).expect_err("the cancelling form of D");
    let swapped =
        |b: &Batch| rungs::in_f32(&Batch { w_l: b.w_v, w_v: b.w_l, ..with_material(b, b.material.clone()) });
    held(Rung::F32, &batches, swapped).expect_err("light and view swapped");
}

#[test]
fn defects_of_the_fused_kernel_are_seen() {
    for (_, level) in rungs::levels() {
        held_to_sense(Rung::Fused, |b| rungs::fused(level, b).unwrap());
    }
    let (level, batches) = (Level::best(), batches());
    // What a reciprocal without its Newton step is off by.
    let estimated = |b: &Batch| {
        let estimate = 1.0 + 1.5 / f64::from(1 << 12);
        rungs::fused(level, b).unwrap().iter().map(|v| v.map(|x| x * estimate)).collect()
    };
    held(Rung::Fused, &batches, estimated).expect_err("a Newton step is missing");
    let rough = |b: &Batch| {
        let floor = |t: Texel<f32>| Texel { roughness: t.roughness.max(1.0 / 255.0), ..t };
        let texels: Vec<_> = b.texels().map(floor).collect();
        rungs::fused(level, &with_material(b, row(&texels))).unwrap()
    };
    held(Rung::Fused, &batches, rough).expect_err("another floor of the roughness");
    let peaks = peaks_near_z();
    for (name, level) in rungs::levels() {
        held(Rung::Fused, &peaks, |b| rungs::fused(level, b).unwrap()).expect(name);
    }
    held(Rung::Fused, &peaks, |b| rungs::projecting(b).unwrap()).expect_err("no cross product");
}

#[cfg(feature = "viewer")]
#[svbrdf_needs::needs(adapter)]
#[test]
fn defects_of_the_gpu_are_seen() {
    use exr::prelude::f16;
    use glam::Vec3;

    let on_gpu = |b: Batch| rungs::on_gpu(&[b]).unwrap().remove(0);
    held_to_sense(Rung::Gpu, |b| on_gpu(with_material(b, b.material.clone())));
    let coarse = |w: Vec3| Vec3::from(w.to_array().map(|x| f16::from_f32(x).to_f32()));
    let mediump = |b: &Batch| {
        let texels: Vec<_> = b.texels().map(|t| Texel { normal: coarse(t.normal), ..t }).collect();
        on_gpu(with_material(b, row(&texels)))
    };
    held(Rung::Gpu, &batches(), mediump).expect_err("normals in half floats");
}
