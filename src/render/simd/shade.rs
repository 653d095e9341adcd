//! Algorithm 3 over a tile: the radiance plus epsilon, from the terms of a material and the geometry of a scene.

use fearless_simd::prelude::*;

use super::geometry::{Ray, Source, dot, sum};
use super::lanes::{Lanes, V, neg_mul_add};
use super::tile::{Plane, Terms, vectors};
use crate::model::convention::Convention;

/// Where a highlight or a boost is above it, radiances are computed and multiplied in the careful way.
const TAME: f32 = 1_048_576.0;

/// Largest radiance and largest factor of one, 2^126: two of its mantissas fit a float.
const LARGEST: f32 = 8.507_059e37;

/// The clamps of a convention, in the units of the kernel.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Clamps {
    /// Whether there are any.
    any: bool,
    /// Where n . q is below, NoH counts as 0.
    behind: f32,
    d_floor: f32,
    g_floor: f32,
}

/// What of a convention the kernel needs.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Model {
    clamps: Clamps,
    epsilon: f32,
    pub(crate) roughness_floor: f32,
}

impl Model {
    /// Of a convention whose epsilon is 0: radiances stay as they are.
    pub(crate) fn without_epsilon(convention: &Convention) -> Self {
        Self { epsilon: 0.0, ..Self::from(convention) }
    }
}

impl From<&Convention> for Model {
    fn from(c: &Convention) -> Self {
        let clamps = Clamps {
            any: c.clamp_n_dot_h || c.d_floor > 0.0 || c.g_floor > 0.0,
            behind: if c.clamp_n_dot_h { 0.0 } else { f32::NEG_INFINITY },
            d_floor: c.d_floor as f32,
            g_floor: (2.0 * c.g_floor) as f32,
        };
        Self { clamps, epsilon: c.epsilon as f32, roughness_floor: c.roughness_floor as f32 }
    }
}

/// R + epsilon of every texel of a tile; R itself where the epsilon of the model is 0.
#[derive(Clone, Debug)]
pub(crate) struct Radiance(pub(crate) [Plane; 3]);

impl Radiance {
    pub(crate) const ZERO: Self = Self([Plane::ZERO; 3]);

    /// Renders a tile, again and carefully where that is needed; says whether it was not. `ray(i)` is the geometry of
    /// vector i.
    #[inline(always)]
    pub(crate) fn render<S: Lanes>(
        &mut self,
        simd: S,
        model: &Model,
        source: &Source,
        terms: &Terms,
        ray: impl Fn(usize) -> Ray<V<S>>,
    ) -> bool {
        let tame = if model.clamps.any {
            self.fill::<S, true, false>(simd, model, terms, &ray)
        } else {
            self.fill::<S, false, false>(simd, model, terms, &ray)
        };
        if tame && source.most_boost <= TAME {
            return true;
        }
        if model.clamps.any {
            self.fill::<S, true, true>(simd, model, terms, &ray);
        } else {
            self.fill::<S, false, true>(simd, model, terms, &ray);
        }
        false
    }

    /// Renders a tile.
    ///
    /// Says whether every value is tame: finite and below 2 [`TAME`]. Where one is not, render it again with
    /// `CAREFUL`.
    #[inline(always)]
    fn fill<S: Lanes, const CLAMPED: bool, const CAREFUL: bool>(
        &mut self,
        simd: S,
        model: &Model,
        terms: &Terms,
        ray: impl Fn(usize) -> Ray<V<S>>,
    ) -> bool {
        let mut highlights = V::<S>::splat(simd, 0.0);
        for i in 0..vectors::<S>() {
            let ray = ray(i);
            let (lobe, e) = lobe::<S, CLAMPED, CAREFUL>(simd, &model.clamps, terms, &ray, i);
            // Sums of positive numbers: at least the largest, and NaN or infinite if any one is.
            highlights += lobe;
            // The chain from the lobe, which comes last, is kept short: (s (1 - w) + w) lobe + (lambert E + epsilon).
            let rest = V::<S>::splat(simd, 1.0) - ray.weight;
            for c in 0..3 {
                let fresnel = terms.specular[c].load(simd, i).mul_add(rest, ray.weight);
                let diffuse = terms.lambert[c].load(simd, i).mul_add(e, V::<S>::splat(simd, model.epsilon));
                let value = fresnel.mul_add(lobe, diffuse);
                let value = if CAREFUL { value.min(V::<S>::splat(simd, LARGEST)) } else { value };
                self.0[c].store::<S>(i, value);
            }
        }
        highlights.simd_le(V::<S>::splat(simd, TAME)).all_true()
    }
}

/// (pi G D / 4 E, E) with the irradiance E = NoL / (pi l.z) times the convention's intensity.
///
/// pi D = (a |q|^2 / (|n x q|^2 + a^2 (n . q)^2))^2. |n x q| is the length of what is left of q without
/// its part along n, exact to a rounding of q; where n is off unit length by a rounding, that adds along n, across
/// what is left, and counts only squared.
#[inline(always)]
fn lobe<S: Lanes, const CLAMPED: bool, const CAREFUL: bool>(
    simd: S,
    clamps: &Clamps,
    terms: &Terms,
    ray: &Ray<V<S>>,
    i: usize,
) -> (V<S>, V<S>) {
    let splat = |c| V::<S>::splat(simd, c);
    let n = terms.normal.each_ref().map(|p| p.load(simd, i));
    let a = terms.a.load(simd, i);
    let q = sum(ray.light, ray.view);
    let n_dot_l = dot(n, ray.light).max(splat(0.0));
    let n_dot_v = dot(n, ray.view).max(splat(0.0));
    // Not the sum of the two: where light and view are nearly opposite, that rounds far above the short q.
    let n_dot_q = dot(n, q);
    let e = n_dot_l * ray.boost;

    let across: [V<S>; 3] = std::array::from_fn(|c| neg_mul_add::<S>(n_dot_q, n[c], q[c]));
    let along = a * n_dot_q;
    // In this order only three additions wait for `across`.
    let mut d = across.iter().fold(along * along, |sum, &c| c.mul_add(c, sum));
    let mut factor_l = n_dot_l.mul_add(terms.one_minus_k.load(simd, i), a);
    let mut factor_v = n_dot_v.mul_add(terms.one_minus_k.load(simd, i), a);
    let peak = a * ray.square;
    if CLAMPED {
        d = n_dot_q.simd_lt(splat(clamps.behind)).select(ray.square, d).max(ray.square * clamps.d_floor);
        factor_l = factor_l.max(splat(clamps.g_floor));
        factor_v = factor_v.max(splat(clamps.g_floor));
    }
    if CAREFUL {
        // Never below its least, a^2 |q|^2, and ratios first: none overflows, none is 0 / 0.
        let ratio = peak / d.max(a * peak);
        let lobe = (ratio / factor_l * (ratio / factor_v) * e).min(splat(LARGEST));
        // Infinity times no light is not a number.
        return (e.simd_gt(splat(0.0)).select(lobe, splat(0.0)), e);
    }
    // One reciprocal and its Newton step: (peak / d)^2 / g = (peak / (d g))^2 g.
    let g = factor_l * factor_v;
    let both = d * g;
    let estimate = simd.recip_estimate(both);
    let ratio = peak * estimate * neg_mul_add::<S>(both, estimate, splat(2.0));
    (ratio * ratio * (g * e), e)
}
