//! Colour spaces by their names in MaterialX: transfer functions, and primaries with a matrix to those of Rec. 709.

use svbrdf_core::math::srgb;

use super::Albedo;

/// Rows of the matrix from linear red, green and blue to those of Rec. 709.
type Matrix = [[f64; 3]; 3];

/// ACES AP1, by the matrix of MaterialX (`cmlib_defs`).
const AP1: Matrix = [
    [1.705_079_555_511_475, -0.624_233_484_268_188_5, -0.080_846_160_650_253_3],
    [-0.129_700_526_595_115_7, 1.138_468_623_161_316, -0.008_768_022_060_394_287],
    [-0.024_166_343_733_668_33, -0.124_614_171_683_788_3, 1.148_780_584_335_327],
];
/// Display P3 and DCI P3 with the white point D65.
const P3: Matrix = [
    [1.224_940_176_280_56, -0.224_940_176_280_56, 0.0],
    [-0.042_056_954_709_688, 1.042_056_954_709_688, 0.0],
    [-0.019_637_554_590_334, -0.078_636_045_550_632, 1.098_273_600_140_966],
];
/// Adobe RGB (1998).
const ADOBE: Matrix = [
    [1.398_355_743_960_778, -0.398_355_743_960_778, 0.0],
    [0.0, 1.0, 0.0],
    [0.0, -0.042_928_989_302_511, 1.042_928_989_302_511],
];
/// Rec. 2020.
const REC2020: Matrix = [
    [1.660_491_002_108_434, -0.587_641_138_788_549, -0.072_849_863_319_885],
    [-0.124_550_474_521_591, 1.132_899_897_125_96, -0.008_349_422_604_369],
    [-0.018_150_763_354_905, -0.100_578_898_008_007, 1.118_729_661_362_913],
];
/// CIE XYZ with the white point D65.
const XYZ: Matrix = [
    [3.240_969_941_904_523, -1.537_383_177_570_094, -0.498_610_760_293_003],
    [-0.969_243_636_280_88, 1.875_967_501_507_721, 0.041_555_057_407_176],
    [0.055_630_079_696_993, -0.203_976_958_888_976, 1.056_971_514_242_878],
];
/// The exponent of Adobe RGB (1998).
const ADOBE_GAMMA: f64 = 563.0 / 256.0;

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
    to_rec709: Option<&'static Matrix>,
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
            "acescg" | "lin_ap1" => (Transfer::Linear, Some(&AP1)),
            "g22_ap1" => (Transfer::Gamma(2.2), Some(&AP1)),
            "srgb_ap1" => (Transfer::Srgb, Some(&AP1)),
            "lin_displayp3" | "lin_p3d65" => (Transfer::Linear, Some(&P3)),
            "displayp3" | "srgb_displayp3" | "srgb_p3d65" => (Transfer::Srgb, Some(&P3)),
            "lin_adobergb" => (Transfer::Linear, Some(&ADOBE)),
            "adobergb" | "g22_adobergb" => (Transfer::Gamma(ADOBE_GAMMA), Some(&ADOBE)),
            "lin_rec2020" => (Transfer::Linear, Some(&REC2020)),
            "lin_ciexyzd65" => (Transfer::Linear, Some(&XYZ)),
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
        let Some(matrix) = self.to_rec709 else { return linear };
        matrix.map(|row| row.iter().zip(linear).map(|(factor, value)| factor * value).sum())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

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
    fn primaries_go_through_their_matrix_after_the_transfer_function() {
        let of = |name: &str, rgb| ColourSpace::of_name(name).unwrap().to_linear(rgb);
        assert_near(of("acescg", [0.0, 0.5, 0.0]), [-0.31212, 0.56923, -0.06231], 1e-5);
        assert_near(of("lin_displayp3", [1.0, 0.0, 0.0]), [1.22494, -0.04206, -0.01964], 1e-5);
        // 0.5 in sRGB stands for 0.21404, in Adobe RGB for 0.21775.
        assert_near(of("srgb_displayp3", [0.5, 0.0, 0.0]), [0.26219, -0.00900, -0.00420], 1e-5);
        assert_near(of("adobergb", [0.5, 0.0, 0.0]), [0.30450, 0.0, 0.0], 1e-4);
    }

    #[test]
    fn the_usual_encodings_have_their_names_and_others_none() {
        let albedo = |name: &str| ColourSpace::of_name(name).map(|space| space.albedo());
        assert_eq!(albedo("srgb_texture"), Some(Some(Albedo::Srgb)));
        assert_eq!(albedo("g22_rec709_scene"), Some(Some(Albedo::Gamma22)));
        assert_eq!(albedo("g18_rec709"), Some(None));
        assert_eq!(albedo("scanner"), None);
    }
}
