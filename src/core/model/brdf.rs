//! Algorithm 3 at one point: one short function per term, generic over the precision.
//!
//! `shaders/brdf.wgsl` is the twin of this file: the same names, argument order and order of operations.
//! All of it is Cook-Torrance with a GGX lobe as Deschaintre et al. (2018-2020) print it; `G` carries the usual
//! `1 / (NoL NoV)` of the microfacet denominator already cancelled.

use super::convention::{Convention, Member};
use crate::math::real::{Real, Vec3, Vector};

/// One texel of a material: its reflectance, before there is a direction of light or view.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Texel<T: Real> {
    /// Unit normal in the frame of the surface (x right, y up, z out of it).
    pub normal: Vec3<T>,
    /// Diffuse albedo, linear RGB in [0, 1].
    pub diffuse: [T; 3],
    /// Specular reflectance at normal incidence, linear RGB in [0, 1].
    pub specular: [T; 3],
    /// Roughness in [0, 1]; the GGX width is its square.
    pub roughness: T,
}

/// The part of a [`Convention`] that rendering needs, in the precision that it renders in.
#[derive(Clone, Copy, Debug)]
pub struct Model<T> {
    pub intensity: T,
    pub roughness_floor: T,
    pub light_z_floor: T,
    pub clamp_n_dot_h: bool,
    pub d_floor: T,
    pub g_floor: T,
    /// What is rendered in the place of Algorithm 3.
    pub member: Option<&'static Member>,
}

impl<T: Real> From<&Convention> for Model<T> {
    fn from(c: &Convention) -> Self {
        Self {
            intensity: T::of(c.intensity),
            roughness_floor: T::of(c.roughness_floor),
            light_z_floor: T::of(c.light_z_floor),
            clamp_n_dot_h: c.clamp_n_dot_h,
            d_floor: T::of(c.d_floor),
            g_floor: T::of(c.g_floor),
            member: c.member,
        }
    }
}

/// The half vector of unit `l` and `v`.
///
/// Where `l = -v` it has no direction; the normal `n` stands in, so that the result stays finite.
#[inline]
pub fn half_vector<V: Vector>(n: V, l: V, v: V) -> V {
    let sum = l + v;
    if sum.is_direction() { sum.normalize() } else { n }
}

/// The GGX distribution D for the square of the roughness, which is the GGX width.
///
/// The printed denominator `NoH^2 (a^2 - 1) + 1` cancels catastrophically as NoH -> 1 and a -> 0. Lagrange's
/// identity `1 - NoH^2 = |n x h|^2` turns it into a sum of two squares, which does not.
/// At most 1 / (pi a^2), reached at h = n.
#[inline]
pub fn distribution<T: Real>(model: &Model<T>, n: Vec3<T>, h: Vec3<T>, a: T) -> T {
    let n_dot_h = n.dot(h);
    let behind = model.clamp_n_dot_h && n_dot_h < T::zero();
    let denominator =
        if behind { T::one() } else { n.cross(h).length_squared() + (a * a) * (n_dot_h * n_dot_h) };
    let ratio = a / denominator.max(model.d_floor);
    T::FRAC_1_PI() * (ratio * ratio)
}

/// One of the two factors of the Schlick-GGX geometry term G, for NoL or NoV in [0, 1].
///
/// `cosine (1 - k) + k` lies in [k, 1], so a factor lies in [1, 1 / k].
#[inline]
pub fn geometry_factor<T: Real>(model: &Model<T>, cosine: T, k: T) -> T {
    (cosine * (T::one() - k) + k).max(model.g_floor).recip()
}

/// Schlick's power of the Fresnel term in its base-2 form (Karis 2013), in [0, 1] for VoH in [0, 1].
#[inline]
pub fn fresnel_weight<T: Real>(v_dot_h: T) -> T {
    ((T::of(-5.55473) * v_dot_h - T::of(6.98316)) * v_dot_h).exp2()
}

/// The Fresnel term F of one channel, in [s, 1].
#[inline]
pub fn fresnel<T: Real>(specular: T, weight: T) -> T {
    specular + (T::one() - specular) * weight
}

/// The Lambertian term of one channel, `d (1 - s) / pi`.
#[inline]
pub fn lambert<T: Real>(diffuse: T, specular: T) -> T {
    diffuse * (T::one() - specular) * T::FRAC_1_PI()
}

/// The factor on the reflectance: `NoL / l.z` times the convention's intensity.
#[inline]
pub fn irradiance<T: Real>(model: &Model<T>, n_dot_l: T, l_z: T) -> T {
    n_dot_l / l_z.max(model.light_z_floor) * model.intensity
}

/// The reflectance (F G D / 4 + d (1 - s) / pi) per RGB channel, for unit `l` and `v` and NoL > 0.
///
/// This is the reciprocal part: swapping `l` and `v` leaves it as it is where both are above the texel.
#[inline]
pub fn reflectance<T: Real>(model: &Model<T>, texel: &Texel<T>, l: Vec3<T>, v: Vec3<T>) -> [T; 3] {
    let n = texel.normal;
    let h = half_vector(n, l, v);
    let n_dot_l = n.dot(l).max(T::zero());
    let n_dot_v = n.dot(v).max(T::zero());
    let v_dot_h = v.dot(h).max(T::zero()).min(T::one());

    let rough = texel.roughness.max(model.roughness_floor);
    let a = rough * rough;
    let k = a * T::of(0.5);
    let d = distribution(model, n, h, a);
    let g = geometry_factor(model, n_dot_l, k) * geometry_factor(model, n_dot_v, k);
    let lobe = g * d * T::of(0.25);
    let weight = fresnel_weight(v_dot_h);
    let channel =
        |c: usize| fresnel(texel.specular[c], weight) * lobe + lambert(texel.diffuse[c], texel.specular[c]);
    [channel(0), channel(1), channel(2)]
}

/// Algorithm 3: the radiance R of one texel, RGB, for directions `w_l` to the light and `w_v` to the viewer of any
/// length.
///
/// Never negative, never NaN; 0 where the light is in or below the plane or behind the texel. Where R would not
/// fit the precision (a light within 1e-15 of the plane), it is the largest finite number.
#[inline]
pub fn render<T: Real>(model: &Model<T>, texel: &Texel<T>, w_l: Vec3<T>, w_v: Vec3<T>) -> [T; 3] {
    let l = w_l.normalize();
    let n_dot_l = texel.normal.dot(l);
    if n_dot_l <= T::zero() || l.z() <= T::zero() {
        return [T::zero(); 3];
    }
    let v = w_v.normalize();
    let e = irradiance(model, n_dot_l, l.z());
    reflectance(model, texel, l, v).map(|f| (f * e).min(T::max_value()))
}
