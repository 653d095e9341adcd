//! Differences of a prediction from the ground truth, as quantities with a unit and a range.
//!
//! `shaders/difference.wgsl` is the twin of [`Difference::of_texel`]; differences of neighbourhoods are computed here only.

use std::str::FromStr;

use glam::DVec3;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use super::flip::flip;
use super::quantity::Quantity;
use crate::error::Error;
use crate::image::Image;

/// How a prediction p differs from the ground truth g at a texel: the mean over RGB of the expression given, with the
/// epsilon of the convention; for normals an angle.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Difference {
    /// |ln(p + epsilon) - ln(g + epsilon)|: its mean over the texels is the rendering loss of the scene.
    Log,
    /// ln(p + epsilon) - ln(g + epsilon).
    SignedLog,
    /// |p - g|.
    Absolute,
    /// p - g.
    Signed,
    /// |p - g| / (g + epsilon).
    Relative,
    /// The angle between two unit normals, in degrees.
    Angle,
    /// FLIP of the exposed renderings: what a person sees who alternates between them. Depends on the neighbourhood of a texel.
    Flip,
}

/// What differences of renderings depend on besides the pictures.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DifferenceParams {
    /// Of the convention.
    pub epsilon: f64,
    /// In stops: of [`Difference::Flip`] alone.
    pub exposure_ev: f32,
}

impl Difference {
    /// The differences that make sense for a quantity, the default first.
    pub fn all(quantity: Quantity) -> &'static [Self] {
        match quantity {
            Quantity::Rendering => {
                &[Self::Log, Self::SignedLog, Self::Absolute, Self::Signed, Self::Relative, Self::Flip]
            }
            _ => Self::pointwise(quantity),
        }
    }

    /// Those of [`Difference::all`] that compare texels one by one, the default first.
    pub fn pointwise(quantity: Quantity) -> &'static [Self] {
        match quantity {
            Quantity::Rendering => {
                &[Self::Log, Self::SignedLog, Self::Absolute, Self::Signed, Self::Relative]
            }
            Quantity::Normal => &[Self::Angle],
            Quantity::Diffuse | Quantity::Specular | Quantity::Roughness => &[Self::Absolute, Self::Signed],
        }
    }

    /// The name for users.
    pub fn name(self) -> &'static str {
        match self {
            Self::Log => "log difference",
            Self::SignedLog => "signed log difference",
            Self::Absolute => "absolute difference",
            Self::Signed => "signed difference",
            Self::Relative => "relative difference",
            Self::Angle => "angle",
            Self::Flip => "FLIP",
        }
    }

    /// The name on the command line and in metadata.
    pub fn key(self) -> &'static str {
        match self {
            Self::Log => "log",
            Self::SignedLog => "signed-log",
            Self::Absolute => "absolute",
            Self::Signed => "signed",
            Self::Relative => "relative",
            Self::Angle => "angle",
            Self::Flip => "flip",
        }
    }

    /// The formula or unit for users.
    pub fn unit(self) -> &'static str {
        match self {
            Self::Log => "|ln p - ln g|",
            Self::SignedLog => "ln p - ln g",
            Self::Absolute => "|p - g|",
            Self::Signed => "p - g",
            Self::Relative => "|p - g| / g",
            Self::Angle => "degrees",
            Self::Flip => "67 pixels per degree",
        }
    }

    /// Whether it can be negative.
    pub fn is_signed(self) -> bool {
        matches!(self, Self::SignedLog | Self::Signed)
    }

    /// The difference that has the last colour before the automatic range is known.
    pub fn default_range(self) -> f64 {
        match self {
            Self::Log | Self::SignedLog => 2.0,
            Self::Absolute | Self::Signed | Self::Relative | Self::Flip => 1.0,
            Self::Angle => 45.0,
        }
    }

    /// The difference at one texel; NaN for FLIP, which compares neighbourhoods.
    pub fn of_texel(self, ground_truth: [f32; 3], prediction: [f32; 3], epsilon: f64) -> f64 {
        match self {
            Self::Angle => angle(ground_truth, prediction),
            _ => self.of_channels(ground_truth, prediction, epsilon).into_iter().sum::<f64>() / 3.0,
        }
    }

    /// The difference of each channel at one texel; of an angle, the same three times; NaN for FLIP.
    pub fn of_channels(self, ground_truth: [f32; 3], prediction: [f32; 3], epsilon: f64) -> [f64; 3] {
        let [g, p] = [ground_truth, prediction].map(|rgb| rgb.map(f64::from));
        let each = |of: &dyn Fn(f64, f64) -> f64| [0, 1, 2].map(|c| of(g[c], p[c]));
        let log = |g: f64, p: f64| (p + epsilon).ln() - (g + epsilon).ln();
        match self {
            Self::Log => each(&|g, p| log(g, p).abs()),
            Self::SignedLog => each(&log),
            Self::Absolute => each(&|g, p| (p - g).abs()),
            Self::Signed => each(&|g, p| p - g),
            Self::Relative => each(&|g, p| (p - g).abs() / (g + epsilon)),
            Self::Angle => [angle(ground_truth, prediction); 3],
            Self::Flip => [f64::NAN; 3],
        }
    }

    /// The difference of each channel of every texel of two pictures of one size; of FLIP, the same three times.
    pub fn picture(
        self,
        ground_truth: &Image<f32>,
        prediction: &Image<f32>,
        params: DifferenceParams,
    ) -> Image<f32> {
        let pixels = match self {
            Self::Flip => {
                let map = flip(ground_truth, prediction, params.exposure_ev);
                map.into_iter().map(|value| [value; 3]).collect()
            }
            _ => {
                let texels = ground_truth.pixels.par_iter().zip(&prediction.pixels);
                let channels = |(g, p): (&[f32; 3], &[f32; 3])| self.of_channels(*g, *p, params.epsilon);
                texels.map(|texel| channels(texel).map(|d| d as f32)).collect()
            }
        };
        Image { width: ground_truth.width, height: ground_truth.height, pixels }
    }

    /// The difference of every texel of two pictures of one size, as [`Quantity::image`] gives them.
    pub fn of_images(
        self,
        ground_truth: &Image<f32>,
        prediction: &Image<f32>,
        params: DifferenceParams,
    ) -> Vec<f32> {
        if self == Self::Flip {
            return flip(ground_truth, prediction, params.exposure_ev);
        }
        let texels = ground_truth.pixels.par_iter().zip(&prediction.pixels);
        texels.map(|(g, p)| self.of_texel(*g, *p, params.epsilon) as f32).collect()
    }
}

/// The angle between two unit vectors, in degrees.
fn angle(a: [f32; 3], b: [f32; 3]) -> f64 {
    let [a, b] = [a, b].map(|v| DVec3::from(v.map(f64::from)));
    a.cross(b).length().atan2(a.dot(b)).to_degrees()
}

impl FromStr for Difference {
    type Err = Error;

    fn from_str(text: &str) -> Result<Self, Error> {
        let all = [Quantity::Rendering, Quantity::Normal].into_iter().flat_map(Self::all);
        let mut named = all.clone().filter(|difference| difference.key() == text);
        named.next().copied().ok_or_else(|| {
            Error::unknown_name(
                "difference",
                text,
                all.map(|difference| difference.key()).collect::<Vec<_>>().join(", "),
            )
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const EVERY: [Difference; 7] = [
        Difference::Log,
        Difference::SignedLog,
        Difference::Absolute,
        Difference::Signed,
        Difference::Relative,
        Difference::Angle,
        Difference::Flip,
    ];

    #[test]
    fn known_differences() {
        let (g, p) = ([0.1, 0.2, 0.4], [0.3, 0.2, 0.1]);
        let ln = |x: f64| (x + 0.01).ln();
        let logs = [ln(0.3) - ln(0.1), 0.0, ln(0.1) - ln(0.4)];
        let expected = [
            (Difference::Log, (logs[0] - logs[2]) / 3.0),
            (Difference::SignedLog, (logs[0] + logs[2]) / 3.0),
            (Difference::Absolute, 0.5 / 3.0),
            (Difference::Signed, -0.1 / 3.0),
            (Difference::Relative, (0.2 / 0.11 + 0.3 / 0.41) / 3.0),
        ];
        for (difference, expected) in expected {
            let got = difference.of_texel(g, p, 0.01);
            assert!((got - expected).abs() < 1e-6, "{difference:?}: {got}, expected {expected}");
            let back = difference.of_texel(p, g, 0.01);
            match difference {
                Difference::Relative => assert!((back - expected).abs() > 1e-3),
                _ if difference.is_signed() => assert!((back + expected).abs() < 1e-6),
                _ => assert!((back - expected).abs() < 1e-6),
            }
        }
    }

    #[test]
    fn an_angle_is_exact_when_small_and_when_large() {
        for degrees in [0.0, 1e-3, 0.5, 45.0, 90.0, 179.0, 180.0_f64] {
            let (sine, cosine) = degrees.to_radians().sin_cos();
            let got = Difference::Angle.of_texel([0.0, 0.0, 1.0], [sine as f32, 0.0, cosine as f32], 0.01);
            assert!((got - degrees).abs() < 1e-5, "{got}, expected {degrees}");
        }
    }

    #[test]
    fn a_picture_does_not_differ_from_itself() {
        let image = Image { width: 2, height: 1, pixels: vec![[0.0, 0.6, 0.8], [1.0, 0.0, 0.0]] };
        let params = DifferenceParams { epsilon: 0.01, exposure_ev: 0.0 };
        for difference in EVERY {
            assert_eq!(difference.of_images(&image, &image, params), [0.0, 0.0], "{difference:?}");
        }
    }

    #[test]
    fn every_quantity_has_a_difference() {
        for quantity in Quantity::ALL {
            let (all, pointwise) = (Difference::all(quantity), Difference::pointwise(quantity));
            assert!(!pointwise.is_empty() && all.starts_with(pointwise), "{quantity:?}");
        }
    }
}
