//! Operations of the kernel beyond portable SIMD: estimates of reciprocal roots, prefetching, and the choice of an
//! instruction set.

use fearless_simd::{Fallback, Simd, prelude::*};

#[cfg(target_arch = "x86_64")]
use fearless_simd::x86::{Avx2, Avx512};

/// Floats in a cache line.
pub(crate) const FLOATS_PER_LINE: usize = 16;

/// A vector of the native width of the instruction set `S`.
pub(crate) type V<S> = <S as Simd>::f32s;

/// Reciprocal roots and prefetching per instruction set. The kernel refines each estimate with a Newton step.
///
/// The default reciprocal root is exact. Estimates differ between processor vendors, and so may the last bits of a loss.
pub(crate) trait Lanes: Simd {
    /// 1 / sqrt(x) for normal x > 0, within a relative 1.5 x 2^-12.
    #[inline(always)]
    fn rsqrt_estimate(self, x: V<Self>) -> V<Self> {
        V::<Self>::splat(self, 1.0) / x.sqrt()
    }

    /// Prefetches a line into the L2 cache. In L1, planes at equal offsets within their pages would evict each other.
    #[inline(always)]
    fn prefetch(self, _line: &[f32; FLOATS_PER_LINE]) {}
}

/// An array of `$value` for each channel or component `$c` in 0..3.
///
/// Not `array::map` or `array::from_fn`: how the crate is divided for code generation decides whether these are calls, and
/// where they are, all vectors go through memory and the loss takes twice as long.
macro_rules! vec3 {
    ($c:ident => $value:expr) => {
        [
            {
                const $c: usize = 0;
                $value
            },
            {
                const $c: usize = 1;
                $value
            },
            {
                const $c: usize = 2;
                $value
            },
        ]
    };
}

pub(crate) use vec3;

/// c - a b.
#[inline(always)]
pub(crate) fn neg_mul_add<S: Simd>(a: V<S>, b: V<S>, c: V<S>) -> V<S> {
    (-a).mul_add(b, c)
}

#[cfg(target_arch = "aarch64")]
impl Lanes for fearless_simd::aarch64::Neon {}

impl Lanes for Fallback {}

/// Implements [`Lanes`] with the estimate of an x86 instruction set.
#[cfg(target_arch = "x86_64")]
macro_rules! estimate {
    ($token:ident, $register:ident, $rsqrt:ident) => {
        impl Lanes for $token {
            #[inline(always)]
            fn rsqrt_estimate(self, x: V<Self>) -> V<Self> {
                fearless_simd::kernel!(
                    #[inline(always)]
                    fn estimate(_token: $token, x: $register) -> $register {
                        std::arch::x86_64::$rsqrt(x)
                    }
                );
                estimate(self, x.into()).simd_into(self)
            }

            #[inline(always)]
            fn prefetch(self, line: &[f32; FLOATS_PER_LINE]) {
                fearless_simd::kernel!(
                    #[inline(always)]
                    fn prefetch(_token: $token, line: &[f32; FLOATS_PER_LINE]) {
                        use std::arch::x86_64::{_MM_HINT_T1, _mm_prefetch};
                        _mm_prefetch::<_MM_HINT_T1>(line.as_ptr().cast());
                    }
                );
                prefetch(self, line);
            }
        }
    };
}

#[cfg(target_arch = "x86_64")]
mod x86 {
    use super::*;
    use std::arch::x86_64::{__m256, __m512};

    estimate!(Avx2, __m256, _mm256_rsqrt_ps);
    estimate!(Avx512, __m512, _mm512_rsqrt14_ps);
}

/// An instruction set of this machine.
#[derive(Clone, Copy, Debug)]
pub struct Level(pub(crate) fearless_simd::Level);

impl Level {
    /// The widest one.
    pub fn best() -> Self {
        Self(fearless_simd::Level::new())
    }

    /// Its name, as [`Level::all`] lists it.
    pub fn name(self) -> &'static str {
        match self.0 {
            #[cfg(target_arch = "x86_64")]
            fearless_simd::Level::Avx512(_) => "avx512",
            #[cfg(target_arch = "x86_64")]
            fearless_simd::Level::Avx2(_) => "avx2",
            #[cfg(target_arch = "aarch64")]
            fearless_simd::Level::Neon(_) => "neon",
            _ => "scalar",
        }
    }

    /// Every instruction set that the kernel supports on this architecture, scalar first; `None` where this machine
    /// lacks it.
    pub fn all() -> Vec<(&'static str, Option<Self>)> {
        let mut all = vec![("scalar", Some(Self(fearless_simd::Level::fallback())))];
        let best = fearless_simd::Level::new();
        #[cfg(target_arch = "x86_64")]
        all.extend([
            ("avx2", best.as_avx2().map(|s| Self(s.level()))),
            ("avx512", best.as_avx512().map(|s| Self(s.level()))),
        ]);
        #[cfg(target_arch = "aarch64")]
        all.push(("neon", best.as_neon().map(|s| Self(s.level()))));
        let _ = best;
        all
    }
}

/// Runs `$call` compiled for the instruction set of a [`Level`], with `$simd` as its token.
macro_rules! dispatch {
    ($level:expr, $simd:ident => $call:expr) => {
        match $level.0 {
            #[cfg(target_arch = "x86_64")]
            fearless_simd::Level::Avx512($simd) => $simd.vectorize(
                #[inline(always)]
                || $call,
            ),
            #[cfg(target_arch = "x86_64")]
            fearless_simd::Level::Avx2($simd) => $simd.vectorize(
                #[inline(always)]
                || $call,
            ),
            #[cfg(target_arch = "aarch64")]
            fearless_simd::Level::Neon($simd) => $simd.vectorize(
                #[inline(always)]
                || $call,
            ),
            _ => {
                let $simd = Fallback::new();
                $simd.vectorize(
                    #[inline(always)]
                    || $call,
                )
            }
        }
    };
}
pub(crate) use dispatch;
