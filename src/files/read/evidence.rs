//! What speaks for or against linear colours.

use std::fmt;

/// One piece of evidence for or against linear colours.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Evidence {
    /// Colours in files of integers are display-encoded by convention.
    Prior,
    /// JPEG is made for display-encoded pictures.
    Jpeg,
    /// Share of the texels whose specular is 0.04 if it is linear.
    LinearDielectrics(f64),
    /// Share of the texels whose specular is 0.04 if it is encoded.
    EncodedDielectrics(f64),
    /// Share of the texels that would reflect more light than arrives if colours were linear.
    TooBright(f64),
}

impl Evidence {
    /// Whether it is a custom of files, not a measurement.
    pub fn is_custom(&self) -> bool {
        matches!(self, Self::Prior | Self::Jpeg)
    }
}

impl fmt::Display for Evidence {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Prior => f.write_str("colours of integers are encoded by convention"),
            Self::Jpeg => f.write_str("JPEG holds encoded colours"),
            Self::LinearDielectrics(share) => {
                write!(f, "specular is near a linear 0.04 in {:.0} % of the texels", 100.0 * share)
            }
            Self::EncodedDielectrics(share) => {
                write!(f, "specular is near an encoded 0.04 in {:.0} % of the texels", 100.0 * share)
            }
            Self::TooBright(share) => {
                write!(
                    f,
                    "linear colours would reflect too much light in {:.0} % of the texels",
                    100.0 * share
                )
            }
        }
    }
}
