//! The terms of Algorithm 3 at one texel, each by itself.

use super::brdf::{self, Model, Texel};
use crate::math::real::{Real, Vec3, Vector as _};

/// What a radiance is made of.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Terms<T> {
    /// Cosine of the angle between normal and light, negative where the light is behind the texel.
    pub n_dot_l: T,
    /// Cosine of the angle between normal and view.
    pub n_dot_v: T,
    /// Cosine of the angle between normal and half vector.
    pub n_dot_h: T,
    /// Cosine of the angle between view and half vector.
    pub v_dot_h: T,
    /// The GGX distribution.
    pub d: T,
    /// The geometry term, with 1 / (NoL NoV) of the microfacet denominator cancelled.
    pub g: T,
    /// The Fresnel term, RGB.
    pub f: [T; 3],
    /// The radiance, RGB, as [`brdf::render`] gives it.
    pub radiance: [T; 3],
}

impl<T: Real> Terms<T> {
    /// The terms of `texel` for directions `w_l` to the light and `w_v` to the viewer of any length.
    pub fn of(model: &Model<T>, texel: &Texel<T>, w_l: Vec3<T>, w_v: Vec3<T>) -> Self {
        let (l, v, n) = (w_l.normalize(), w_v.normalize(), texel.normal);
        let h = brdf::half_vector(n, l, v);
        let (n_dot_l, n_dot_v, v_dot_h) = (n.dot(l), n.dot(v), v.dot(h));
        let rough = texel.roughness.max(model.roughness_floor);
        let a = rough * rough;
        let k = a * T::of(0.5);
        let factor = |cosine: T| brdf::geometry_factor(model, cosine.max(T::zero()), k);
        let weight = brdf::fresnel_weight(v_dot_h.max(T::zero()).min(T::one()));
        Self {
            n_dot_l,
            n_dot_v,
            n_dot_h: n.dot(h),
            v_dot_h,
            d: brdf::distribution(model, n, h, a),
            g: factor(n_dot_l) * factor(n_dot_v),
            f: texel.specular.map(|specular| brdf::fresnel(specular, weight)),
            radiance: brdf::render(model, texel, w_l, w_v),
        }
    }
}
