//! Evidence for or against linear colours.

use derive_more::Display;

/// One piece of evidence for or against linear colours.
#[derive(Clone, Copy, Debug, PartialEq, Display)]
pub enum Evidence {
    #[display("colours of integers are encoded by convention")]
    Prior,
    /// Sets of diffuse, specular and roughness.
    #[display(
        "colours of integers are encoded by convention, but some research codes store diffuse and specular linear"
    )]
    Research,
    #[display("JPEG holds encoded colours")]
    Jpeg,
    /// Share of the texels.
    #[display("specular is near a linear 0.04 in {:.0}% of the texels", 100.0 * _0)]
    LinearDielectrics(f64),
    /// Share of the texels.
    #[display("specular is near an encoded 0.04 in {:.0}% of the texels", 100.0 * _0)]
    EncodedDielectrics(f64),
    /// Share of the texels.
    #[display("linear colours would reflect too much light in {:.0}% of the texels", 100.0 * _0)]
    TooBright(f64),
    /// Share of the texels.
    #[display("linear colours would be those of no material in {:.0}% of the texels", 100.0 * _0)]
    NoMaterial(f64),
    /// If it is encoded, darker than most materials are. Stored median.
    #[display("the median of the colour is {_0:.3}, which suggests linear colours")]
    Dark(f64),
    /// The median of the specular of metals, as stored, and the log odds of linear: what metals reflect is known.
    #[display(
        "the specular of metals has a median of {median:.3}, which suggests {} colours",
        suggested(*log_odds)
    )]
    Metals { median: f64, log_odds: f64 },
}

fn suggested(log_odds: f64) -> &'static str {
    if log_odds > 0.0 { "linear" } else { "encoded" }
}

impl Evidence {
    /// Whether it is a custom of files, not a measurement.
    pub fn is_custom(&self) -> bool {
        matches!(self, Self::Prior | Self::Research | Self::Jpeg)
    }
}
