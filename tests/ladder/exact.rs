//! Algorithm 3 as printed, in 256 bits: independent of the rearrangements in `brdf`.

use std::array::from_fn;
use std::sync::LazyLock;

use dashu_float::FBig;
use dashu_float::round::mode::HalfEven;
use glam::Vec3;

use svbrdf_core::model::brdf::Texel;
use svbrdf_core::model::convention::Convention;

type Big = FBig<HalfEven, 2>;
type BigVec = [Big; 3];

const BITS: usize = 256;
static PI: LazyLock<Big> = LazyLock::new(|| Big::pi(BITS));
static LN_2: LazyLock<Big> = LazyLock::new(|| big(2.0).ln());

fn big(x: f64) -> Big {
    Big::try_from(x).unwrap().with_precision(BITS).value()
}

fn dot(a: &BigVec, b: &BigVec) -> Big {
    &a[0] * &b[0] + &a[1] * &b[1] + &a[2] * &b[2]
}

fn unit(a: &BigVec) -> BigVec {
    let length = dot(a, a).sqrt();
    from_fn(|i| &a[i] / &length)
}

fn vector(a: Vec3) -> BigVec {
    a.to_array().map(|x| big(x.into()))
}

/// The radiance R of a texel, rounded to f64 at the end. The inputs are taken as exact; the normal is normalized.
pub fn radiance(c: &Convention, texel: &Texel<f32>, w_l: Vec3, w_v: Vec3) -> [f64; 3] {
    let [zero, one, two] = [0.0, 1.0, 2.0].map(big);
    let [n, l, v] = [texel.normal, w_l, w_v].map(|w| unit(&vector(w)));
    let n_dot_l = dot(&n, &l);
    if n_dot_l <= zero || l[2] <= zero {
        return [0.0; 3];
    }
    let sum: BigVec = from_fn(|i| (&l[i] + &v[i]) / &two);
    let h = if sum.iter().all(|x| *x == zero) { n.clone() } else { unit(&sum) };
    let n_dot_v = dot(&n, &v).max(zero.clone());
    let n_dot_h = dot(&n, &h);
    let n_dot_h = if c.clamp_n_dot_h { n_dot_h.max(zero) } else { n_dot_h };
    let v_dot_h = dot(&v, &h);

    let rough = big(texel.roughness.into()).max(big(c.roughness_floor));
    let rough_2 = &rough * &rough;
    let d_denominator = &n_dot_h * &n_dot_h * (&rough_2 * &rough_2 - &one) + &one;
    let d_root = &rough_2 / d_denominator.max(big(c.d_floor));
    let d = &d_root * &d_root / &*PI;
    let k = &rough_2 / &two;
    let g_denominator = |cosine: &Big| (cosine * (&one - &k) + &k).max(big(c.g_floor));
    let g = &one / (g_denominator(&n_dot_l) * g_denominator(&n_dot_v));
    let power = (big(-5.55473) * &v_dot_h - big(6.98316)) * &v_dot_h;
    let weight = (power * &*LN_2).exp();
    let irradiance = big(c.intensity) * &n_dot_l / l[2].clone().max(big(c.light_z_floor));
    from_fn(|i| {
        let [s, d_albedo] = [texel.specular[i], texel.diffuse[i]].map(|x| big(x.into()));
        let f = &s + (&one - &s) * &weight;
        let r = (f * &g * &d / big(4.0) + d_albedo * (&one - &s) / &*PI) * &irradiance;
        r.to_f64().value()
    })
}
