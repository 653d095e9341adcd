//! Algorithm 3 over a tile: the radiance plus epsilon, from the terms of a material and the geometry of a scene.
//!
//! There are three ways to compute it. The fast path is right where no width a = rough^2 is below [`NARROW`], no q is
//! short, and no highlight overflows. The careful path takes a cross product for the denominator of D and a dot product of
//! its own for n . q, and is right for any width and any q. The overflow-safe path does so too, and divides before it
//! multiplies.

use fearless_simd::prelude::*;

use super::geometry::{Geometry, KernelScene, cross, dot, sum};
use super::lanes::{Lanes, V, neg_mul_add, vec3};
use super::tile::{MaterialTerms, TilePlane, vectors};
use crate::model::convention::Convention;

/// Largest highlight and light scale of the fast and the careful path. Above, a tile takes the overflow-safe path.
const FAST_LIMIT: f32 = 1_048_576.0;

/// Largest radiance and largest factor of one, 2^126. The product of two mantissas of such numbers fits a float.
const LARGEST: f32 = 8.507_059e37;

/// A tile with a GGX width below 1e-4 (r = 0.01) takes the careful path.
///
/// The fast path takes what is left of q without its part along n. A normal that is off unit length by 2 u, and 7 u |q| of
/// rounding in n . q where q is not short, leave up to 11 u |q| along n, with u = 2^-24. It adds as a square to
/// |n x q|^2 + (a n . q)^2, so D is off by a relative 2 (11 u / a)^2 at most: 8.6e-5 at a = 1e-4, but 1 at a = 9e-7.
const NARROW: f32 = 0.01 * 0.01;

/// The clamps of a convention, in the units of the kernel.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Clamps {
    /// Whether there are any.
    any: bool,
    /// Where n . q is below it, NoH counts as 0.
    behind: f32,
    d_floor: f32,
    g_floor: f32,
}

/// The numbers of a convention that shading needs.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ShadingParams {
    clamps: Clamps,
    epsilon: f32,
    pub(crate) roughness_floor: f32,
    /// A tile with a smaller GGX width takes the careful path.
    pub(crate) narrow: f32,
}

impl ShadingParams {
    /// Those of a convention with an epsilon of 0: the radiance itself.
    pub(crate) fn without_epsilon(convention: &Convention) -> Self {
        Self { epsilon: 0.0, ..Self::from(convention) }
    }
}

impl From<&Convention> for ShadingParams {
    fn from(c: &Convention) -> Self {
        let clamps = Clamps {
            any: c.clamp_n_dot_h || c.d_floor > 0.0 || c.g_floor > 0.0,
            behind: if c.clamp_n_dot_h { 0.0 } else { f32::NEG_INFINITY },
            d_floor: c.d_floor as f32,
            g_floor: (2.0 * c.g_floor) as f32,
        };
        // A floor of the denominator of D bounds it as a^2 does.
        let narrow = if clamps.d_floor < NARROW * NARROW { NARROW } else { 0.0 };
        Self { clamps, epsilon: c.epsilon as f32, roughness_floor: c.roughness_floor as f32, narrow }
    }
}

/// R + epsilon of every texel of a tile; R itself where the epsilon is 0.
#[derive(Clone, Debug)]
pub(crate) struct TileRadiance(pub(crate) [TilePlane; 3]);

impl TileRadiance {
    pub(crate) const ZERO: Self = Self([TilePlane::ZERO; 3]);

    /// Renders a tile. Returns whether all radiances are below 2 [`FAST_LIMIT`]; where one is not, the tile was rendered
    /// a second time on the overflow-safe path. `geometry(i)` is the geometry of vector i, `is_short` whether a q of the
    /// tile is short.
    #[inline(always)]
    pub(crate) fn render<S: Lanes>(
        &mut self,
        simd: S,
        params: &ShadingParams,
        scene: &KernelScene,
        terms: &MaterialTerms,
        is_short: bool,
        geometry: impl Fn(usize) -> Geometry<V<S>>,
    ) -> bool {
        let is_clamped = params.clamps.any;
        let below_limit = match (is_clamped, terms.is_narrow || is_short) {
            (false, false) => self.fill::<S, false, false, false>(simd, params, terms, &geometry),
            (false, true) => self.fill::<S, false, true, false>(simd, params, terms, &geometry),
            (true, false) => self.fill::<S, true, false, false>(simd, params, terms, &geometry),
            (true, true) => self.fill::<S, true, true, false>(simd, params, terms, &geometry),
        };
        if below_limit && scene.largest_light_scale <= FAST_LIMIT {
            return true;
        }
        if is_clamped {
            self.fill::<S, true, true, true>(simd, params, terms, &geometry);
        } else {
            self.fill::<S, false, true, true>(simd, params, terms, &geometry);
        }
        false
    }

    /// Renders a tile on one of the three paths: fast, `CAREFUL`, or `CAREFUL` and overflow-safe (`SAFE`).
    ///
    /// Returns whether every highlight is a number and at most [`FAST_LIMIT`].
    #[inline(always)]
    fn fill<S: Lanes, const CLAMPED: bool, const CAREFUL: bool, const SAFE: bool>(
        &mut self,
        simd: S,
        params: &ShadingParams,
        terms: &MaterialTerms,
        geometry: impl Fn(usize) -> Geometry<V<S>>,
    ) -> bool {
        let mut highlights = V::<S>::splat(simd, 0.0);
        for i in 0..vectors::<S>() {
            let geometry = geometry(i);
            let (lobe, e) = lobe::<S, CLAMPED, CAREFUL, SAFE>(simd, &params.clamps, terms, &geometry, i);
            // The sum of positive numbers is at least the largest, and NaN or infinite if any one is.
            highlights += lobe;
            // (s (1 - w) + w) lobe + (lambert E + epsilon): only one operation waits for the lobe, which comes last.
            let weight = geometry.fresnel_weight;
            let rest = V::<S>::splat(simd, 1.0) - weight;
            for c in 0..3 {
                let fresnel = terms.specular[c].load(simd, i).mul_add(rest, weight);
                let diffuse = terms.lambert[c].load(simd, i).mul_add(e, V::<S>::splat(simd, params.epsilon));
                let value = fresnel.mul_add(lobe, diffuse);
                let value = if SAFE { value.min(V::<S>::splat(simd, LARGEST)) } else { value };
                self.0[c].store::<S>(i, value);
            }
        }
        highlights.simd_le(V::<S>::splat(simd, FAST_LIMIT)).all_true()
    }
}

/// (pi G D / 4 E, E) with the irradiance E = NoL / (pi l.z) times the convention's intensity.
///
/// pi D = (a |q|^2 / (|n x q|^2 + a^2 (n . q)^2))^2. |n x q| is the length of what is left of q without its part along
/// n, where the path is not `CAREFUL`.
#[inline(always)]
fn lobe<S: Lanes, const CLAMPED: bool, const CAREFUL: bool, const SAFE: bool>(
    simd: S,
    clamps: &Clamps,
    terms: &MaterialTerms,
    geometry: &Geometry<V<S>>,
    i: usize,
) -> (V<S>, V<S>) {
    let splat = |c| V::<S>::splat(simd, c);
    let n = TilePlane::load_three(&terms.normal, simd, i);
    let a = terms.a.load(simd, i);
    let q = sum(geometry.light, geometry.view);
    let (along_l, along_v) = (dot(n, geometry.light), dot(n, geometry.view));
    // Where light and view are nearly opposite, the sum rounds far above the short q.
    let n_dot_q = if CAREFUL { dot(n, q) } else { along_l + along_v };
    let (n_dot_l, n_dot_v) = (along_l.max(splat(0.0)), along_v.max(splat(0.0)));
    let e = n_dot_l * geometry.light_scale;

    let across: [V<S>; 3] =
        if CAREFUL { cross::<S>(n, q) } else { vec3!(C => neg_mul_add::<S>(n_dot_q, n[C], q[C])) };
    let along = a * n_dot_q;
    // In this order only three additions wait for `across`.
    let [x, y, z] = across;
    let mut d = z.mul_add(z, y.mul_add(y, x.mul_add(x, along * along)));
    let mut factor_l = n_dot_l.mul_add(terms.one_minus_k.load(simd, i), a);
    let mut factor_v = n_dot_v.mul_add(terms.one_minus_k.load(simd, i), a);
    let peak = a * geometry.square;
    if CLAMPED {
        let square = geometry.square;
        d = n_dot_q.simd_lt(splat(clamps.behind)).select(square, d).max(square * clamps.d_floor);
        factor_l = factor_l.max(splat(clamps.g_floor));
        factor_v = factor_v.max(splat(clamps.g_floor));
    }
    if SAFE {
        // d is at least a^2 |q|^2. With ratios first, none overflows and none is 0 / 0.
        let ratio = peak / d.max(a * peak);
        let lobe = (ratio / factor_l * (ratio / factor_v) * e).min(splat(LARGEST));
        // Infinity times an irradiance of 0 is not a number.
        return (e.simd_gt(splat(0.0)).select(lobe, splat(0.0)), e);
    }
    // One division: (peak / d)^2 / g = (peak / (d g))^2 g.
    let g = factor_l * factor_v;
    let ratio = peak / (d * g);
    (ratio * ratio * (g * e), e)
}
