//! Evidence for or against linear colours.

use std::fmt;

/// One piece of evidence for or against linear colours.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Evidence {
    /// Colours in files of integers are display-encoded by convention.
    Prior,
    /// Sets of diffuse, specular and roughness are written by research codes, some of which store them linear.
    Research,
    /// JPEG is made for display-encoded pictures.
    Jpeg,
    /// Share of the texels whose specular is 0.04 if it is linear.
    LinearDielectrics(f64),
    /// Share of the texels whose specular is 0.04 if it is encoded.
    EncodedDielectrics(f64),
    /// Share of the texels that would reflect more light than arrives if colours were linear.
    TooBright(f64),
    /// The median of diffuse, if it is encoded, is darker than most materials are. Stored median.
    Dark(f64),
    /// The median of the specular of metals, as stored, and the log odds of linear: what metals reflect is known.
    Metals { median: f64, log_odds: f64 },
    /// Pictures of neighbouring materials with the same file names: their count and log odds.
    Neighbours { count: usize, log_odds: f64 },
}

impl Evidence {
    /// Whether it is a custom of files, not a measurement.
    pub fn is_custom(&self) -> bool {
        matches!(self, Self::Prior | Self::Research | Self::Jpeg)
    }
}

impl fmt::Display for Evidence {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let percent = |share: &f64| 100.0 * share;
        let suggested = |log_odds: &f64| if *log_odds > 0.0 { "linear" } else { "encoded" };
        match self {
            Self::Prior => f.write_str("colours of integers are encoded by convention"),
            Self::Research => f.write_str(
                "colours of integers are encoded by convention, but some research codes store diffuse and specular linear",
            ),
            Self::Jpeg => f.write_str("JPEG holds encoded colours"),
            Self::LinearDielectrics(share) => {
                write!(f, "specular is near a linear 0.04 in {:.0}% of the texels", percent(share))
            }
            Self::EncodedDielectrics(share) => {
                write!(f, "specular is near an encoded 0.04 in {:.0}% of the texels", percent(share))
            }
            Self::TooBright(share) => write!(
                f,
                "linear colours would reflect too much light in {:.0}% of the texels",
                percent(share)
            ),
            Self::Dark(median) => {
                write!(f, "the median of the colour is {median:.3}, which suggests linear colours")
            }
            Self::Metals { median, log_odds } => write!(
                f,
                "the specular of metals has a median of {median:.3}, which suggests {} colours",
                suggested(log_odds)
            ),
            Self::Neighbours { count, log_odds } => {
                let (materials, suggest) =
                    if *count == 1 { ("material", "suggests") } else { ("materials", "suggest") };
                let suggested = suggested(log_odds);
                write!(f, "{count} neighbouring {materials} of the same file names {suggest} {suggested} colours")
            }
        }
    }
}
