//! The compute bound: the throughput of multiply-adds of this machine over the operations that a loss needs.

use std::hint::black_box;

use fearless_simd::{Simd, dispatch, prelude::*};

use crate::job::fastest;

/// Floating-point operations per texel and scene of a well arranged kernel, for `predictions` predictions.
///
/// One prediction: 156 (48 FMA, 35 multiplications, 3 divisions, 3 square roots, ...), of which 52 are the geometry, 46
/// each of the two materials, 12 the comparison. The geometry and the ground truth are shared by all predictions.
pub fn flops_per_texel_scene(predictions: usize) -> f64 {
    const GEOMETRY: f64 = 52.0;
    const MATERIAL: f64 = 46.0;
    const COMPARISON: f64 = 12.0;
    GEOMETRY + MATERIAL + predictions as f64 * (MATERIAL + COMPARISON)
}

/// Nanoseconds per pp at the throughput of multiply-adds that this machine shows now on the threads there are.
pub fn bound() -> f64 {
    let once = || rayon::broadcast(|_| dispatch!(fearless_simd::Level::new(), simd => multiply_add(simd)));
    let flops: usize = once().into_iter().sum();
    flops_per_texel_scene(1) * 1e9 * fastest(|| drop(black_box(once()))) / flops as f64
}

/// Many independent multiply-adds; says how many operations they are.
#[inline(always)]
fn multiply_add<S: Simd>(simd: S) -> usize {
    const CHAINS: usize = 12;
    const STEPS: usize = 100_000;
    let splat = |x: f32| S::f32s::splat(simd, black_box(x));
    let (factor, term) = (splat(0.5), splat(1.5));
    let mut chains: [S::f32s; CHAINS] = std::array::from_fn(|i| splat(i as f32));
    for _ in 0..STEPS {
        for chain in &mut chains {
            *chain = chain.mul_add(factor, term);
        }
    }
    let sum = chains.into_iter().fold(term, |sum, chain| sum + chain);
    black_box(sum[0]);
    2 * CHAINS * STEPS * S::f32s::LEN
}
