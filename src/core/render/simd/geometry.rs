//! The geometry that all materials share: light, half vector and Fresnel weight of a scene at every texel of a tile.

use fearless_simd::{Simd, prelude::*};
use glam::DVec3;

use super::lanes::{Lanes, V, neg_mul_add, vec3};
use super::tile::{Positions, TilePlane, vectors};
use crate::model::convention::Convention;
use crate::model::scene::{Kind, Scene};

/// Least height of a light or view above the plane, so that f32 can square and invert it. Lower ones are moved to it.
const LEAST_HEIGHT: f64 = 1e-18;
/// Below this |q|^2, q is short: VoH < 1/2, an angle of over 120 degrees between light and view.
const SHORT_SQUARE: f32 = 4.0;
/// Added to |q|^2, so that it is positive where light and view are opposite. Far below the rounding of q there.
const LEAST_SQUARE: f32 = 1e-18;

/// The geometry of a vector of texels.
///
/// Directions have length 2, which saves a multiplication, and the half vector is never normalized: q = 2 l + 2 v,
/// |q|^2 = 16 VoH^2.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Geometry<F> {
    /// 2 l.
    pub(crate) light: [F; 3],
    /// 2 v.
    pub(crate) view: [F; 3],
    /// |q|^2.
    pub(crate) square: F,
    /// Schlick's power of the Fresnel term.
    pub(crate) fresnel_weight: F,
    /// Irradiance / NoL in the units of the kernel: the convention's intensity / (2 pi l.z).
    pub(crate) light_scale: F,
}

/// A scene in the form that the kernel needs.
#[derive(Clone, Debug)]
pub(crate) struct KernelScene {
    near: bool,
    light: [f32; 3],
    view: [f32; 3],
    /// Intensity / (4 pi L.z) for the near light at L, intensity / (2 pi l.z) for the distant one.
    light_scale: f32,
    /// The largest light scale that the convention's floor of l.z allows.
    light_scale_limit: f32,
    /// The largest light scale of any texel.
    pub(crate) largest_light_scale: f32,
}

impl KernelScene {
    /// `reach`: the largest distance of a texel from the origin.
    pub(crate) fn new(scene: &Scene, convention: &Convention, reach: f64) -> Self {
        let above_plane = |p: [f64; 3]| {
            let p = if scene.kind == Kind::Near { p } else { DVec3::from(p).normalize().to_array() };
            DVec3::from([p[0], p[1], p[2].max(LEAST_HEIGHT)])
        };
        let (light, view) = (above_plane(scene.light), above_plane(scene.view));
        let near = scene.kind == Kind::Near;
        let intensity = convention.intensity / std::f64::consts::TAU;
        let light_scale = intensity / light.z;
        let limit = intensity / convention.light_z_floor.max(1e-30);
        let farthest = if near { light.length() + reach } else { 1.0 };
        Self {
            near,
            light: light.to_array().map(|c| c as f32),
            view: view.to_array().map(|c| c as f32),
            light_scale: if near { light_scale / 2.0 } else { light_scale } as f32,
            light_scale_limit: limit as f32,
            largest_light_scale: (light_scale * farthest).min(limit) as f32,
        }
    }

    /// The geometry of a distant scene, the same at every texel; `None` for a near-field one.
    #[inline(always)]
    pub(crate) fn distant<S: Lanes>(&self, simd: S) -> Option<Geometry<V<S>>> {
        if self.near {
            return None;
        }
        let light = vec3!(C => V::<S>::splat(simd, 2.0 * self.light[C]));
        let view = vec3!(C => V::<S>::splat(simd, 2.0 * self.view[C]));
        let light_scale = V::<S>::splat(simd, self.light_scale.min(self.light_scale_limit));
        let (square, fresnel_weight) = half_way(simd, sum(light, view));
        Some(Geometry { light, view, square, fresnel_weight, light_scale })
    }

    /// A near-field scene in registers.
    #[inline(always)]
    fn splat<S: Simd>(&self, simd: S) -> NearScene<V<S>> {
        let splat = |c| V::<S>::splat(simd, c);
        NearScene {
            light: vec3!(C => splat(self.light[C])),
            view: vec3!(C => splat(self.view[C])),
            light_scale: splat(self.light_scale),
            light_scale_limit: splat(self.light_scale_limit),
        }
    }
}

/// A near-field scene in registers. The fields are as in [`KernelScene`].
struct NearScene<F> {
    light: [F; 3],
    view: [F; 3],
    light_scale: F,
    light_scale_limit: F,
}

/// (2 l, 2 v, light scale) of a near-field scene at a vector of texels.
#[inline(always)]
fn near<S: Lanes>(simd: S, scene: &NearScene<V<S>>, x: V<S>, y: V<S>) -> ([V<S>; 3], [V<S>; 3], V<S>) {
    let from_texel = |p: [V<S>; 3]| [p[0] - x, p[1] - y, p[2]];
    let (to_light, to_view) = (from_texel(scene.light), from_texel(scene.view));
    let light_square = dot(to_light, to_light);
    let per_light = twice_rsqrt(simd, light_square);
    let per_view = twice_rsqrt(simd, dot(to_view, to_view));
    let light_scale = (light_square * per_light * scene.light_scale).min(scene.light_scale_limit);
    (vec3!(C => to_light[C] * per_light), vec3!(C => to_view[C] * per_view), light_scale)
}

/// a . b.
#[inline(always)]
pub(crate) fn dot<S: Simd, F: SimdFloat<S>>(a: [F; 3], b: [F; 3]) -> F {
    a[0].mul_add(b[0], a[1].mul_add(b[1], a[2] * b[2]))
}

/// a x b.
#[inline(always)]
pub(crate) fn cross<S: Simd>(a: [V<S>; 3], b: [V<S>; 3]) -> [V<S>; 3] {
    let component = |i: usize, j: usize| neg_mul_add::<S>(a[j], b[i], a[i] * b[j]);
    [component(1, 2), component(2, 0), component(0, 1)]
}

/// a + b.
#[inline(always)]
pub(crate) fn sum<S: Simd, F: SimdFloat<S>>(a: [F; 3], b: [F; 3]) -> [F; 3] {
    vec3!(C => a[C] + b[C])
}

/// (|q|^2, Schlick's power).
#[inline(always)]
fn half_way<S: Lanes>(simd: S, q: [V<S>; 3]) -> (V<S>, V<S>) {
    let least = V::<S>::splat(simd, LEAST_SQUARE);
    let square = q[2].mul_add(q[2], q[1].mul_add(q[1], q[0].mul_add(q[0], least)));
    (square, exp2(simd, fresnel_power(simd, square)))
}

/// Whether a lane holds the |q|^2 of a short q.
#[inline(always)]
pub(crate) fn is_short<S: Simd>(simd: S, square: V<S>) -> bool {
    square.simd_lt(V::<S>::splat(simd, SHORT_SQUARE)).any_true()
}

/// 2 / sqrt(x). The Newton step leaves 1.5 times the square of the relative error of the estimate.
#[inline(always)]
fn twice_rsqrt<S: Lanes>(simd: S, x: V<S>) -> V<S> {
    let estimate = simd.rsqrt_estimate(x);
    estimate * neg_mul_add::<S>(x * estimate, estimate, V::<S>::splat(simd, 3.0))
}

/// (-5.55473 VoH - 6.98316) VoH from 16 VoH^2.
///
/// The Newton step of the square root, root + root / 2 (1 - root estimate), is multiplied out: a shorter chain.
#[inline(always)]
fn fresnel_power<S: Lanes>(simd: S, square: V<S>) -> V<S> {
    const LINEAR: f32 = -6.98316 / 4.0;
    const QUADRATIC: f32 = -5.55473 / 16.0;
    let estimate = simd.rsqrt_estimate(square);
    let root = square * estimate;
    let error = neg_mul_add::<S>(root, estimate, V::<S>::splat(simd, 1.0));
    let power = root.mul_add(LINEAR, square * QUADRATIC);
    (root * (LINEAR / 2.0)).mul_add(error, power)
}

/// 2^x for x in [-126, 1], within a relative 1.5e-7.
///
/// The nearest integer becomes the exponent. The rest, in [-1/2, 1/2], goes through a minimax polynomial (Remez, 7.5e-8).
#[inline(always)]
fn exp2<S: Simd>(simd: S, x: V<S>) -> V<S> {
    /// 1.5 x 2^23. Adding it rounds to the nearest integer and leaves it in the low bits.
    const ROUND: f32 = 12_582_912.0;
    let rounded = x + ROUND;
    let rest = x - (rounded - ROUND);
    let pair = |low: f32, high: f32| rest.mul_add(high, V::<S>::splat(simd, low));
    let square = rest * rest;
    let value = pair(0.240_221_2, 0.055_507_133);
    let value = square.mul_add(pair(0.009_675_541, 0.001_327_647_2), value);
    let value = square.mul_add(value, pair(1.000_000_1, 0.693_146_97));
    V::<S>::from_bits(value.to_bits() + (rounded.to_bits() << 23))
}

/// The geometry of a near-field scene at every texel of a tile.
#[derive(Clone, Debug)]
pub(crate) struct TileGeometry {
    light: [TilePlane; 3],
    view: [TilePlane; 3],
    square: TilePlane,
    fresnel_weight: TilePlane,
    light_scale: TilePlane,
}

impl TileGeometry {
    pub(crate) const ZERO: Self = Self {
        light: [TilePlane::ZERO; 3],
        view: [TilePlane::ZERO; 3],
        square: TilePlane::ZERO,
        fresnel_weight: TilePlane::ZERO,
        light_scale: TilePlane::ZERO,
    };

    /// Two loops, because the reorder buffer of a processor does not hold enough vectors of a single one, whose chain of
    /// dependent operations reaches from the position to the Fresnel weight.
    ///
    /// Returns whether a q of the tile is short.
    #[inline(always)]
    pub(crate) fn fill<S: Lanes>(&mut self, simd: S, scene: &KernelScene, positions: &Positions) -> bool {
        let scene = scene.splat(simd);
        for i in 0..vectors::<S>() {
            let (light, view, light_scale) =
                near(simd, &scene, positions.x.load(simd, i), positions.y.load(simd, i));
            for c in 0..3 {
                self.light[c].store::<S>(i, light[c]);
                self.view[c].store::<S>(i, view[c]);
            }
            self.light_scale.store::<S>(i, light_scale);
        }
        let mut shortest = V::<S>::splat(simd, SHORT_SQUARE);
        for i in 0..vectors::<S>() {
            let light = TilePlane::load_three(&self.light, simd, i);
            let view = TilePlane::load_three(&self.view, simd, i);
            let (square, fresnel_weight) = half_way(simd, sum(light, view));
            shortest = shortest.min(square);
            self.square.store::<S>(i, square);
            self.fresnel_weight.store::<S>(i, fresnel_weight);
        }
        is_short(simd, shortest)
    }

    #[inline(always)]
    pub(crate) fn load<S: Simd>(&self, simd: S, i: usize) -> Geometry<V<S>> {
        Geometry {
            light: TilePlane::load_three(&self.light, simd, i),
            view: TilePlane::load_three(&self.view, simd, i),
            square: self.square.load(simd, i),
            fresnel_weight: self.fresnel_weight.load(simd, i),
            light_scale: self.light_scale.load(simd, i),
        }
    }
}
