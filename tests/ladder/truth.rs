//! Expected value, condition and region of each extreme case.

use glam::DVec3;

use svbrdf_core::model::brdf::{self, Model, Texel};

use super::cases::Batch;
use crate::support::points::error_bound;
use crate::support::tolerance::{POINT_ULPS, SIMD_ULPS};

/// One ulp of f32 relative to a number just above a power of two.
const ULP: f64 = f32::EPSILON as f64;
/// |l + v| below which light and view are nearly opposite: 174 degrees apart.
const OPPOSITE: f64 = 0.1;
/// Where one ulp of an input changes the result by more, relative to it, no f32 can be right to 1e-3.
const ILL_CONDITIONED: f64 = 1e-4;

svbrdf_core::choices! {
    /// The rows of the table.
    Region, "region":
    Rough = "r >= 0.5",
    Satin = "0.1 <= r < 0.5",
    GlossyBeside = "0.01 <= r < 0.1, beside the highlight",
    GlossyHighlight = "0.01 <= r < 0.1, in the highlight",
    MirrorBeside = "r < 0.01, beside the highlight",
    MirrorHighlight = "r < 0.01, in the highlight",
    Grazing = "light or view grazing",
    Opposite = "light nearly opposite the view",
    IllHighlight = "ill-conditioned: in the highlight",
    IllHorizon = "ill-conditioned: light on the horizon of the texel",
    IllOpposite = "ill-conditioned: light nearly opposite the view",
    Dark = "no light: R = 0",
}

/// The result in f64 at one texel, and how sensitive it is, per channel.
pub struct Truth {
    pub expected: [f64; 3],
    /// The largest relative change of the result where one number of the input is moved by one ulp of f32, or a fourth of
    /// the change where it is moved by four. Where light and view are nearly opposite, also the change over all half
    /// vectors that one ulp of l and v can reach: there a highlight can be narrower than one step.
    pub one_ulp: [f64; 3],
    pub region: [Region; 3],
    /// How far f32 may be off, and the kernel: `error_bound`.
    pub bound: [f64; 3],
    pub simd_bound: [f64; 3],
    /// How far f64 may be off.
    pub f64_bound: [f64; 3],
}

/// The texel in f64, its normal brought to length 1.
fn in_f64(texel: &Texel<f32>) -> Texel<f64> {
    Texel {
        normal: texel.normal.as_dvec3().normalize(),
        diffuse: texel.diffuse.map(f64::from),
        specular: texel.specular.map(f64::from),
        roughness: texel.roughness.into(),
    }
}

/// `brdf::render` behind its normalization: `l` and `v` may be a little off length 1.
fn shade(model: &Model<f64>, texel: &Texel<f64>, l: DVec3, v: DVec3) -> [f64; 3] {
    let n_dot_l = texel.normal.dot(l);
    if n_dot_l <= 0.0 || l.z <= 0.0 {
        return [0.0; 3];
    }
    let e = brdf::irradiance(model, n_dot_l, l.z);
    brdf::reflectance(model, texel, l, v).map(|f| f * e)
}

/// See [`Truth::one_ulp`]. The numbers are the components of n, l and v, once l and v have length 1, the roughness, and
/// the albedos. Rounding a component of l and v changes their length too, which turns h where they are opposite; where
/// l + v is no longer than a few ulps, h is all rounding.
fn one_ulp(model: &Model<f64>, texel: &Texel<f64>, l: DVec3, v: DVec3) -> [f64; 3] {
    let from = shade(model, texel, l, v);
    if from != [0.0; 3] && (l + v).length() < 4.0 * ULP {
        return [f64::INFINITY; 3];
    }
    let mut most = [0.0f64; 3];
    for ulps in [1.0, -1.0, 4.0, -4.0f64] {
        let step = 1.0 + ulps * ULP;
        let mut moved = |texel: &Texel<f64>, l, v| {
            for ((most, from), to) in most.iter_mut().zip(from).zip(shade(model, texel, l, v)) {
                let change = if from == to { 0.0 } else { (to - from).abs() / (ulps.abs() * from) };
                *most = most.max(change);
            }
        };
        let turned = |w: DVec3, axis: usize| {
            let mut w = w.to_array();
            w[axis] *= step;
            DVec3::from(w)
        };
        for axis in 0..3 {
            moved(&Texel { normal: turned(texel.normal, axis), ..*texel }, l, v);
            moved(texel, turned(l, axis), v);
            moved(texel, l, turned(v, axis));
        }
        moved(&Texel { roughness: texel.roughness * step, ..*texel }, l, v);
        let scaled = |albedo: [f64; 3]| albedo.map(|x| x * step);
        moved(&Texel { diffuse: scaled(texel.diffuse), ..*texel }, l, v);
        moved(&Texel { specular: scaled(texel.specular), ..*texel }, l, v);
    }
    most
}

impl Truth {
    pub fn of(batch: &Batch) -> Vec<Self> {
        let model = Model::from(&batch.convention);
        let [l, v] = [batch.w_l, batch.w_v].map(|w| w.as_dvec3().normalize());
        batch.texels().map(|texel| Self::of_texel(&model, &in_f64(&texel), l, v)).collect()
    }

    fn of_texel(model: &Model<f64>, texel: &Texel<f64>, l: DVec3, v: DVec3) -> Self {
        /// An operation of f64 is off by this share of what one of f32 is off by.
        const F64_BY_F32: f64 = f64::EPSILON / f32::EPSILON as f64;
        let expected = brdf::render(model, texel, l, v);
        let mut one_ulp = one_ulp(model, texel, l, v);
        if (l + v).length() < OPPOSITE {
            /// One ulp of f32 in the unit of `error_bound`.
            const ONE_ULP: f64 = 2.0;
            let reach = error_bound(model, texel, l, v, ONE_ULP);
            for c in (0..3).filter(|&c| expected[c] > 0.0) {
                one_ulp[c] = one_ulp[c].max(reach[c] / expected[c]);
            }
        }
        let region = [0, 1, 2].map(|c| region(model, texel, [l, v], expected[c], one_ulp[c]));
        let bound = |ulps| error_bound(model, texel, l, v, ulps).map(|b| b + f64::from(f32::MIN_POSITIVE));
        let (bound, simd_bound) = (bound(POINT_ULPS), bound(SIMD_ULPS));
        let exactly_opposite = (l + v).length() < 4.0 * f64::EPSILON;
        let f64_bound = if exactly_opposite {
            [f64::INFINITY; 3]
        } else {
            error_bound(model, texel, l, v, POINT_ULPS * F64_BY_F32)
        };
        Self { expected, one_ulp, region, bound, simd_bound, f64_bound }
    }
}

/// The region of a channel that should give `expected`.
fn region(model: &Model<f64>, texel: &Texel<f64>, [l, v]: [DVec3; 2], expected: f64, one_ulp: f64) -> Region {
    /// Sine of the angle, 5.7 degrees, within which of a horizon a light or a view is grazing.
    const GRAZING: f64 = 0.1;
    /// A highlight reaches this many GGX widths from the mirror direction: there D is 1/4000 of its peak.
    const WIDTHS: f64 = 8.0;
    let (n, rough) = (texel.normal, texel.roughness.max(model.roughness_floor));
    let in_highlight = n.cross(brdf::half_vector(n, l, v)).length() < WIDTHS * rough * rough;
    let opposite = (l + v).length() < OPPOSITE;
    if expected == 0.0 && one_ulp == 0.0 {
        Region::Dark
    } else if one_ulp > ILL_CONDITIONED {
        match opposite {
            true => Region::IllOpposite,
            false if n.dot(l).abs() < 1e-3 => Region::IllHorizon,
            false => Region::IllHighlight,
        }
    } else if opposite {
        Region::Opposite
    } else if [n.dot(l), n.dot(v), l.z, v.z].iter().any(|cosine| cosine.abs() < GRAZING) {
        Region::Grazing
    } else {
        match (rough, in_highlight) {
            (0.5.., _) => Region::Rough,
            (0.1.., _) => Region::Satin,
            (0.01.., false) => Region::GlossyBeside,
            (0.01.., true) => Region::GlossyHighlight,
            (_, false) => Region::MirrorBeside,
            (_, true) => Region::MirrorHighlight,
        }
    }
}
