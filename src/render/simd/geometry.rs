//! What all materials share: the light, the half vector and the Fresnel power of a scene at every texel of a tile.

use fearless_simd::{Simd, prelude::*};
use glam::DVec3;

use super::lanes::{Lanes, V, neg_mul_add};
use super::tile::{Places, Plane, vectors};
use crate::model::convention::Convention;
use crate::model::scene::{Kind, Scene};

/// A light or view closer to the plane is lifted to this height, so that f32 can square and invert it.
const LOWEST: f64 = 1e-18;
/// Added to |q|^2, so that it is positive where light and view are opposite: far below the rounding of q there.
const LEAST_SQUARE: f32 = 1e-18;

/// The geometry of a vector of texels.
///
/// Directions have length 2, which saves a multiplication, and the half vector is never normalized: q = 2 l + 2 v,
/// |q|^2 = 16 VoH^2.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Ray<F> {
    /// 2 l.
    pub(crate) light: [F; 3],
    /// 2 v.
    pub(crate) view: [F; 3],
    /// |q|^2.
    pub(crate) square: F,
    /// Schlick's power.
    pub(crate) weight: F,
    /// The convention's intensity / (2 pi l.z).
    pub(crate) boost: F,
}

/// A scene in the form that the kernel needs.
#[derive(Clone, Debug)]
pub(crate) struct Source {
    near: bool,
    light: [f32; 3],
    view: [f32; 3],
    /// Intensity / (4 pi L.z) for the near light at L, intensity / (2 pi l.z) for the distant one.
    boost: f32,
    /// Most that a boost may be: the convention's floor of l.z.
    boost_limit: f32,
    /// No boost exceeds this.
    pub(crate) most_boost: f32,
}

impl Source {
    /// `reach` is the largest distance of a texel from the origin.
    pub(crate) fn new(scene: &Scene, convention: &Convention, reach: f64) -> Self {
        let lift = |p: [f64; 3]| {
            let p = if scene.kind == Kind::Near { p } else { DVec3::from(p).normalize().to_array() };
            DVec3::from([p[0], p[1], p[2].max(LOWEST)])
        };
        let (light, view) = (lift(scene.light), lift(scene.view));
        let near = scene.kind == Kind::Near;
        let intensity = convention.intensity / std::f64::consts::TAU;
        let boost = intensity / light.z;
        let limit = intensity / convention.light_z_floor.max(1e-30);
        let farthest = if near { light.length() + reach } else { 1.0 };
        Self {
            near,
            light: light.to_array().map(|c| c as f32),
            view: view.to_array().map(|c| c as f32),
            boost: if near { boost / 2.0 } else { boost } as f32,
            boost_limit: limit as f32,
            most_boost: (boost * farthest).min(limit) as f32,
        }
    }

    /// The geometry of a distant scene, the same at every texel; `None` for a near-field one.
    #[inline(always)]
    pub(crate) fn distant<S: Lanes>(&self, simd: S) -> Option<Ray<V<S>>> {
        if self.near {
            return None;
        }
        let splat = |p: [f32; 3]| p.map(|c| V::<S>::splat(simd, 2.0 * c));
        let (light, view) = (splat(self.light), splat(self.view));
        let boost = V::<S>::splat(simd, self.boost.min(self.boost_limit));
        let (square, weight) = half_way(simd, sum(light, view));
        Some(Ray { light, view, square, weight, boost })
    }

    /// The numbers of the scene as vectors.
    #[inline(always)]
    fn splat<S: Simd>(&self, simd: S) -> Near<V<S>> {
        let splat = |c| V::<S>::splat(simd, c);
        Near {
            light: self.light.map(splat),
            view: self.view.map(splat),
            boost: splat(self.boost),
            boost_limit: splat(self.boost_limit),
        }
    }
}

/// A near-field scene in registers, see [`Source`].
struct Near<F> {
    light: [F; 3],
    view: [F; 3],
    boost: F,
    boost_limit: F,
}

/// (2 l, 2 v, boost) of a near-field scene at a vector of texels.
#[inline(always)]
fn near<S: Lanes>(simd: S, scene: &Near<V<S>>, x: V<S>, y: V<S>) -> ([V<S>; 3], [V<S>; 3], V<S>) {
    let from_texel = |p: [V<S>; 3]| [p[0] - x, p[1] - y, p[2]];
    let (to_light, to_view) = (from_texel(scene.light), from_texel(scene.view));
    let light_square = dot(to_light, to_light);
    let per_light = twice_rsqrt(simd, light_square);
    let per_view = twice_rsqrt(simd, dot(to_view, to_view));
    let boost = (light_square * per_light * scene.boost).min(scene.boost_limit);
    (to_light.map(|c| c * per_light), to_view.map(|c| c * per_view), boost)
}

/// a . b.
#[inline(always)]
pub(crate) fn dot<S: Simd, F: SimdFloat<S>>(a: [F; 3], b: [F; 3]) -> F {
    a[0].mul_add(b[0], a[1].mul_add(b[1], a[2] * b[2]))
}

/// a + b.
#[inline(always)]
pub(crate) fn sum<S: Simd, F: SimdFloat<S>>(a: [F; 3], b: [F; 3]) -> [F; 3] {
    std::array::from_fn(|i| a[i] + b[i])
}

/// (|q|^2, Schlick's power).
#[inline(always)]
fn half_way<S: Lanes>(simd: S, q: [V<S>; 3]) -> (V<S>, V<S>) {
    let least = V::<S>::splat(simd, LEAST_SQUARE);
    let square = q.iter().fold(least, |sum, &c| c.mul_add(c, sum));
    (square, exp2(simd, fresnel_power(simd, square)))
}

/// 2 / sqrt(x): a Newton step leaves 1.5 times the square of the estimate's relative error.
#[inline(always)]
fn twice_rsqrt<S: Lanes>(simd: S, x: V<S>) -> V<S> {
    let estimate = simd.rsqrt_estimate(x);
    estimate * neg_mul_add::<S>(x * estimate, estimate, V::<S>::splat(simd, 3.0))
}

/// (-5.55473 VoH - 6.98316) VoH from 16 VoH^2.
///
/// The Newton step of the square root, root + root / 2 (1 - root estimate), is multiplied out to shorten the chain.
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
/// The nearest integer goes to the exponent; the rest, in [-1/2, 1/2], to a minimax polynomial (Remez, 7.5e-8).
#[inline(always)]
fn exp2<S: Simd>(simd: S, x: V<S>) -> V<S> {
    /// 1.5 x 2^23: adding it rounds to the nearest integer, which the low bits then hold.
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
pub(crate) struct Rays {
    light: [Plane; 3],
    view: [Plane; 3],
    square: Plane,
    weight: Plane,
    boost: Plane,
}

impl Rays {
    pub(crate) const ZERO: Self = Self {
        light: [Plane::ZERO; 3],
        view: [Plane::ZERO; 3],
        square: Plane::ZERO,
        weight: Plane::ZERO,
        boost: Plane::ZERO,
    };

    /// In two loops: one chain of operations from the place to the power would be so long that the processor runs
    /// out of room to work on enough vectors at a time.
    #[inline(always)]
    pub(crate) fn fill<S: Lanes>(&mut self, simd: S, source: &Source, places: &Places) {
        let scene = source.splat(simd);
        for i in 0..vectors::<S>() {
            let (light, view, boost) = near(simd, &scene, places.x.load(simd, i), places.y.load(simd, i));
            for c in 0..3 {
                self.light[c].store::<S>(i, light[c]);
                self.view[c].store::<S>(i, view[c]);
            }
            self.boost.store::<S>(i, boost);
        }
        for i in 0..vectors::<S>() {
            let load = |direction: &[Plane; 3]| direction.each_ref().map(|p| p.load(simd, i));
            let (square, weight) = half_way(simd, sum(load(&self.light), load(&self.view)));
            self.square.store::<S>(i, square);
            self.weight.store::<S>(i, weight);
        }
    }

    #[inline(always)]
    pub(crate) fn load<S: Simd>(&self, simd: S, i: usize) -> Ray<V<S>> {
        Ray {
            light: self.light.each_ref().map(|p| p.load(simd, i)),
            view: self.view.each_ref().map(|p| p.load(simd, i)),
            square: self.square.load(simd, i),
            weight: self.weight.load(simd, i),
            boost: self.boost.load(simd, i),
        }
    }
}
