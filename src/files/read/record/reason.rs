//! Reasons of assumptions: a sentence each, with what it rests on, such as evidence for or against linear colours.

use std::borrow::Cow;
use std::fmt;

use derive_more::Display;

/// The reason of an assumption.
#[derive(Clone, Debug, PartialEq)]
pub struct Reason {
    text: Cow<'static, str>,
    ground: Ground,
}

/// What a reason rests on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ground {
    /// A user, a specification, or a name or a file that leaves nothing open.
    Statement,
    /// The convention that colours of integers are encoded.
    Convention,
    /// What some codes do with an order of tiles, or with names, which pixels may outweigh.
    Code,
    /// The same of the codes of Deschaintre et al., which store colours linear.
    Deschaintre,
    /// Evidence about the encoding of colours, or another reason that something contradicts.
    Weighed {
        /// Whether customs of files alone decide, and colours are encoded.
        by_custom: bool,
    },
    /// Pixels, or customs that a file need not follow.
    Measurement,
}

impl Reason {
    /// A user specified it.
    pub(crate) const SPECIFIED: Self = Self::fixed(Ground::Statement, "as specified");
    pub(crate) const FLOATS: Self = Self::fixed(Ground::Statement, "floats are linear");
    pub(crate) const NATIVE_TEXT: Self =
        Self::fixed(Ground::Statement, "svbrdf wrote the file, with its encoding");
    pub(crate) const LISTED: Self = Self::fixed(Ground::Statement, "the file lists its textures");

    pub(crate) const fn fixed(ground: Ground, text: &'static str) -> Self {
        Self { text: Cow::Borrowed(text), ground }
    }

    pub(crate) fn stated(text: impl Into<Cow<'static, str>>) -> Self {
        Self { text: text.into(), ground: Ground::Statement }
    }

    pub(crate) fn measured(text: impl Into<Cow<'static, str>>) -> Self {
        Self { text: text.into(), ground: Ground::Measurement }
    }

    /// The sum of the `evidence` for and against linear colours, in log odds.
    pub(crate) fn weighed(log_odds: f64, evidence: &[Evidence]) -> Self {
        let text = evidence.iter().map(ToString::to_string).collect::<Vec<_>>().join("; ");
        let by_custom = log_odds < 0.0 && evidence.iter().all(Evidence::is_custom);
        Self { text: text.into(), ground: Ground::Weighed { by_custom } }
    }

    #[must_use]
    pub(crate) fn contradicted(&self, by: &Self) -> Self {
        let text = format!("{self}, but {by}: check it").into();
        Self { text, ground: Ground::Weighed { by_custom: false } }
    }

    pub fn ground(&self) -> Ground {
        self.ground
    }

    /// Whether a specification, a name, or the user states it: not only a measurement of pixels, and not a custom that a
    /// file need not follow.
    pub fn is_stated(&self) -> bool {
        matches!(self.ground, Ground::Statement | Ground::Convention | Ground::Weighed { by_custom: true })
    }

    /// Whether it is no more than a custom of some codes, that pixels may outweigh.
    pub(crate) fn is_custom_of_codes(&self) -> bool {
        matches!(self.ground, Ground::Code | Ground::Deschaintre)
    }
}

impl fmt::Display for Reason {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.text)
    }
}

impl serde::Serialize for Reason {
    /// The words.
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(&self.text)
    }
}

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
