//! What reading took for granted, as values that a user can see, doubt and change.

use std::fmt;

use serde::Serialize;

/// Why what the user says is assumed.
pub(crate) const AS_YOU_SAID: &str = "as you said";

/// What an assumption is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum What {
    /// Which part of a picture or file is which map.
    Layout,
    /// Whether colours are diffuse and specular, or a base colour and metallic.
    Workflow,
    /// Colour space of diffuse or base colour.
    Albedo,
    /// Colour space of specular.
    Specular,
    /// Direction of y in the normal map.
    NormalY,
    /// How the components of normals are stored.
    NormalCode,
    /// What a roughness value means.
    Roughness,
    /// What the renderer that the diffuse was made for does with it.
    Energy,
    /// A map that is not there.
    Missing,
    /// Maps of different sizes.
    Size,
    /// Values that had to be changed.
    Values,
}

impl What {
    /// How users read it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Layout => "layout",
            Self::Workflow => "workflow",
            Self::Albedo => "albedo",
            Self::Specular => "specular",
            Self::NormalY => "normal y",
            Self::NormalCode => "normal code",
            Self::Roughness => "roughness",
            Self::Energy => "energy",
            Self::Missing => "missing",
            Self::Size => "size",
            Self::Values => "values",
        }
    }
}

/// How far an assumption can be trusted.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Certainty {
    /// Could as well be otherwise: look at it. `--strict` refuses it.
    Unsure,
    /// A convention or the pixels speak for it.
    Likely,
    /// The file says so.
    Sure,
    /// The user said so.
    Given,
}

/// One thing that was taken for granted, and why.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Assumption {
    pub what: What,
    pub chosen: String,
    pub why: String,
    pub certainty: Certainty,
}

impl Assumption {
    pub fn new(what: What, chosen: impl fmt::Display, why: impl Into<String>, certainty: Certainty) -> Self {
        Self { what, chosen: chosen.to_string(), why: why.into(), certainty }
    }

    /// An assumption that the user made.
    pub fn given(what: What, chosen: impl fmt::Display) -> Self {
        Self::new(what, chosen, AS_YOU_SAID, Certainty::Given)
    }
}

impl fmt::Display for Assumption {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let doubt = if self.certainty == Certainty::Unsure { " (unsure)" } else { "" };
        write!(f, "{}: {}{doubt}: {}", self.what.name(), self.chosen, self.why)
    }
}
