//! Transfer functions, from stored values of [0, 1] to reflectance and roughness and back, and colour spaces: transfer functions and primaries,
//! by their names in MaterialX or by chromaticities, with a matrix to those of Rec. 709.

use glam::{DMat3, DVec3};

use svbrdf_core::math::real::Real;
use svbrdf_core::math::srgb;

use crate::read::options::{Albedo, Roughness};

/// The dark end of the logarithmic encoding.
const DARK: f64 = 0.01;

/// The reflectance, in [0, 1], that a stored `value` of [0, 1] stands for.
pub(crate) fn linear<T: Real>(value: T, albedo: Albedo) -> T {
    match albedo {
        Albedo::Linear => value,
        Albedo::Srgb => srgb::decode(value),
        Albedo::Gamma22 => value.powf(T::of(2.2)),
        Albedo::Log => T::of((DARK * ((1.0 + DARK) / DARK).powf(value.f64()) - DARK).clamp(0.0, 1.0)),
    }
}

/// The stored value of the reflectance `value` of [0, 1]: the inverse of [`linear`].
pub(crate) fn encoded<T: Real>(value: T, albedo: Albedo) -> T {
    match albedo {
        Albedo::Linear => value,
        Albedo::Srgb => srgb::encode(value),
        Albedo::Gamma22 => value.powf(T::one() / T::of(2.2)),
        Albedo::Log => T::of(((value.f64() + DARK) / DARK).ln() / ((1.0 + DARK) / DARK).ln()),
    }
}

/// The roughness r that a stored `value` of [0, 1] stands for.
pub(crate) fn roughness(value: f64, code: Roughness) -> f64 {
    match code {
        Roughness::R => value,
        Roughness::Gloss => 1.0 - value,
        Roughness::Alpha | Roughness::Anisotropic => value.sqrt(),
        Roughness::Gamma22 => value.powf(2.2),
    }
}

/// What a strip has before the encoding of its tiles.
pub(crate) const PACKED: &str = "packed ndrs, ";

/// The encoding that this program states in a picture whose colours it stores so.
pub(crate) fn written(albedo: Albedo) -> String {
    format!("diffuse {albedo}, specular {albedo}, roughness r, normal y up, energy scaled")
}

/// ACES AP1, by the matrix of MaterialX (`cmlib_defs`), column by column.
const AP1: DMat3 = DMat3::from_cols_array(&[
    1.705_079_555_511_475,
    -0.129_700_526_595_115_7,
    -0.024_166_343_733_668_33,
    -0.624_233_484_268_188_5,
    1.138_468_623_161_316,
    -0.124_614_171_683_788_3,
    -0.080_846_160_650_253_3,
    -0.008_768_022_060_394_287,
    1.148_780_584_335_327,
]);
/// CIE XYZ with the white point D65.
const XYZ: DMat3 = DMat3::from_cols_array(&[
    3.240_969_941_904_523,
    -0.969_243_636_280_88,
    0.055_630_079_696_993,
    -1.537_383_177_570_094,
    1.875_967_501_507_721,
    -0.203_976_958_888_976,
    -0.498_610_760_293_003,
    0.041_555_057_407_176,
    1.056_971_514_242_878,
]);
/// The responses of cones to XYZ of Bradford.
const BRADFORD: DMat3 =
    DMat3::from_cols_array(&[0.8951, -0.7502, 0.0389, 0.2664, 1.7135, -0.0685, -0.1614, 0.0367, 1.0296]);
const D65: [f64; 2] = [0.3127, 0.3290];
/// Display P3 and DCI P3 with the white point D65.
const P3: Chromaticities = [[0.68, 0.32], [0.265, 0.69], [0.15, 0.06], D65];
/// Adobe RGB (1998).
const ADOBE: Chromaticities = [[0.64, 0.33], [0.21, 0.71], [0.15, 0.06], D65];
const REC2020: Chromaticities = [[0.708, 0.292], [0.17, 0.797], [0.131, 0.046], D65];
/// The exponent of Adobe RGB (1998).
const ADOBE_GAMMA: f64 = 563.0 / 256.0;

/// x and y of red, green, blue and white in CIE 1931.
pub(crate) type Chromaticities = [[f64; 2]; 4];

/// The matrix from linear red, green and blue of these primaries to those of Rec. 709, by Bradford's adaptation of their white to D65: white
/// stays white. `None` where the primaries enclose no white, or are not finite.
pub(crate) fn to_rec709([red, green, blue, white]: Chromaticities) -> Option<DMat3> {
    let xyz = |[x, y]: [f64; 2]| DVec3::new(x, y, 1.0 - x - y);
    let primaries = DMat3::from_cols(xyz(red), xyz(green), xyz(blue));
    let whites = [white, D65].map(|white| xyz(white) / white[1]);
    let amounts = primaries.inverse() * whites[0];
    if primaries.determinant().abs() < 1e-6 || !(amounts.is_finite() && amounts.min_element() > 0.0) {
        return None;
    }
    let [own, d65] = whites.map(|white| BRADFORD * white);
    let adapted = BRADFORD.inverse() * DMat3::from_diagonal(d65 / own) * BRADFORD;
    Some(XYZ * adapted * primaries * DMat3::from_diagonal(amounts)).filter(|matrix| matrix.is_finite())
}

/// How stored colours stand for light.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Transfer {
    Linear,
    Srgb,
    Gamma(f64),
}

/// A colour space: how values are encoded, and of which primaries they are.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct ColourSpace {
    transfer: Transfer,
    /// `None` for those of Rec. 709.
    to_rec709: Option<DMat3>,
}

impl ColourSpace {
    /// The colour space of this name in MaterialX, with or without `_scene` at its end, or in the configurations of OpenColorIO, such as
    /// `Utility - sRGB - Texture`; `None` of a name that is not known.
    pub(crate) fn of_name(name: &str) -> Option<Self> {
        let name = name.to_lowercase().replace(" - ", "_").replace([' ', '-'], "_");
        let name = name.strip_prefix("utility_").unwrap_or(&name);
        let (transfer, to_rec709) = match name.strip_suffix("_scene").unwrap_or(name) {
            "lin_rec709" | "lin_srgb" | "linear_srgb" | "none" | "raw" | "data" | "non_color" => {
                (Transfer::Linear, None)
            }
            "srgb_texture" | "srgb_tx" | "srgb" | "srgb_rec709" | "srgb_encoded_rec.709_(srgb)" => {
                (Transfer::Srgb, None)
            }
            "gamma18" | "g18_rec709" => (Transfer::Gamma(1.8), None),
            "gamma22" | "g22_rec709" => (Transfer::Gamma(2.2), None),
            "gamma24" | "g24_rec709" => (Transfer::Gamma(2.4), None),
            "acescg" | "lin_ap1" => (Transfer::Linear, Some(AP1)),
            "g22_ap1" => (Transfer::Gamma(2.2), Some(AP1)),
            "srgb_ap1" => (Transfer::Srgb, Some(AP1)),
            "lin_displayp3" | "lin_p3d65" => (Transfer::Linear, to_rec709(P3)),
            "displayp3" | "srgb_displayp3" | "srgb_p3d65" => (Transfer::Srgb, to_rec709(P3)),
            "lin_adobergb" => (Transfer::Linear, to_rec709(ADOBE)),
            "adobergb" | "g22_adobergb" => (Transfer::Gamma(ADOBE_GAMMA), to_rec709(ADOBE)),
            "lin_rec2020" => (Transfer::Linear, to_rec709(REC2020)),
            "lin_ciexyzd65" => (Transfer::Linear, Some(XYZ)),
            _ => return None,
        };
        Some(Self { transfer, to_rec709 })
    }

    /// The encoding by its name here; `None` where colours have to be [converted](Self::to_linear).
    pub(crate) fn albedo(&self) -> Option<Albedo> {
        match (self.transfer, self.to_rec709) {
            (Transfer::Linear, None) => Some(Albedo::Linear),
            (Transfer::Srgb, None) => Some(Albedo::Srgb),
            (Transfer::Gamma(2.2), None) => Some(Albedo::Gamma22),
            _ => None,
        }
    }

    /// Linear red, green and blue of Rec. 709; outside [0, 1] where Rec. 709 does not have the colour.
    pub(crate) fn to_linear(self, stored: [f64; 3]) -> [f64; 3] {
        let linear = stored.map(|value| match self.transfer {
            Transfer::Linear => value,
            Transfer::Srgb => srgb::decode(value),
            Transfer::Gamma(gamma) => value.max(0.0).powf(gamma),
        });
        self.to_rec709.map_or(linear, |matrix| (matrix * DVec3::from(linear)).to_array())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn encoding_is_the_inverse_of_decoding() {
        for step in 0..=1000 {
            let value = f64::from(step) / 1000.0;
            for albedo in Albedo::ALL {
                assert!((linear(encoded(value, albedo), albedo) - value).abs() < 1e-7, "{albedo}: {value}");
            }
        }
    }

    /// The code of `logOutputAlbedos` as Deschaintre et al. print it.
    #[test]
    fn the_logarithmic_code_is_theirs() {
        let theirs = |x: f64| ((x + 0.01).ln() - 0.01_f64.ln()) / (1.01_f64.ln() - 0.01_f64.ln());
        for x in [0.0, 0.04, 0.5, 1.0] {
            assert!((encoded(x, Albedo::Log) - theirs(x)).abs() < 1e-14);
        }
    }

    #[track_caller]
    fn assert_near(got: [f64; 3], expected: [f64; 3], within: f64) {
        assert!(got.iter().zip(expected).all(|(a, b)| (a - b).abs() < within), "{got:?}, not {expected:?}");
    }

    #[test]
    fn names_of_opencolorio_are_those_of_materialx() {
        let albedo = |name: &str| ColourSpace::of_name(name).and_then(|space| space.albedo());
        for name in ["sRGB - Texture", "srgb_tx", "Utility - sRGB - Texture", "srgb_texture"] {
            assert_eq!(albedo(name), Some(Albedo::Srgb), "{name}");
        }
        for name in ["Utility - Raw", "data", "Non-Color", "raw", "Utility - Linear - sRGB"] {
            assert_eq!(albedo(name), Some(Albedo::Linear), "{name}");
        }
        assert_eq!(albedo("Output - sRGB"), None);
    }

    #[test]
    fn white_is_white_of_all_primaries() {
        for name in [
            "acescg",
            "lin_ap1_scene",
            "displayp3",
            "lin_displayp3",
            "adobergb",
            "lin_adobergb",
            "lin_rec2020",
        ] {
            assert_near(ColourSpace::of_name(name).unwrap().to_linear([1.0; 3]), [1.0; 3], 1e-5);
        }
        // D65 in XYZ.
        let white = ColourSpace::of_name("lin_ciexyzd65").unwrap().to_linear([0.95046, 1.0, 1.08906]);
        assert_near(white, [1.0; 3], 1e-3);
    }

    #[test]
    fn chromaticities_give_the_matrices_that_are_published() {
        // ACES AP1 by Bradford: the matrix in public shaders ("ACEScg to sRGB").
        let ap1 = to_rec709([[0.713, 0.293], [0.165, 0.83], [0.128, 0.044], [0.32168, 0.33767]]).unwrap();
        let [x, y, z] = ap1.transpose().to_cols_array_2d();
        assert_near(x, [1.70505, -0.62179, -0.08326], 2e-4);
        assert_near(y, [-0.13026, 1.14080, -0.01055], 2e-4);
        assert_near(z, [-0.02400, -0.12897, 1.15297], 2e-4);
        let rec709 = to_rec709([[0.64, 0.33], [0.3, 0.6], [0.15, 0.06], D65]).unwrap();
        assert!(rec709.abs_diff_eq(DMat3::IDENTITY, 1e-6), "{rec709}");
    }
}
