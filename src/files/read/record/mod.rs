//! The record of a reading: assumptions, as values that a user can inspect and change, and notes, with their words.

mod note;
mod reason;

use std::fmt;

use serde::Serialize;

pub use note::{Note, Subject, Unused};
pub use reason::{Evidence, Ground, Reason};

/// The subject of an assumption.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
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
    NormalEncoding,
    /// The meaning of a roughness value.
    Roughness,
    /// Whether the renderer that diffuse was made for scales it by (1 - specular).
    Energy,
    /// A map that is not there.
    Missing,
    /// Maps of different sizes.
    Size,
    /// Values that had to be changed.
    Values,
}

impl What {
    /// The name for users.
    pub fn name(self) -> &'static str {
        match self {
            Self::Layout => "layout",
            Self::Workflow => "workflow",
            Self::Albedo => "albedo",
            Self::Specular => "specular",
            Self::NormalY => "normal y",
            Self::NormalEncoding => "normal encoding",
            Self::Roughness => "roughness",
            Self::Energy => "energy",
            Self::Missing => "missing",
            Self::Size => "size",
            Self::Values => "values",
        }
    }

    /// The key of the option of reading that specifies it, where a value of it is refused as a guess.
    pub fn key(self) -> Option<&'static str> {
        Some(match self {
            Self::Layout => "order",
            Self::Workflow => "workflow",
            Self::Albedo => "albedo",
            Self::Specular => "specular-albedo",
            Self::NormalY => "normal-y",
            Self::NormalEncoding => "normal-encoding",
            Self::Roughness => "roughness",
            Self::Energy => "energy",
            Self::Missing | Self::Size | Self::Values => return None,
        })
    }
}

/// How far an assumption can be trusted.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "lowercase")]
pub enum Certainty {
    /// Another reading is as plausible. Strict reading refuses it.
    Unsure,
    /// A convention or the pixels suggest it.
    Likely,
    /// The file declares it, or the specification of its format does.
    Sure,
    /// The user specified it.
    Given,
}

/// One thing that was assumed, and why.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Assumption {
    pub what: What,
    /// The choice, for the user.
    pub chosen: String,
    /// In words.
    #[cfg_attr(feature = "schema", schemars(with = "String"))]
    pub why: Reason,
    pub certainty: Certainty,
}

impl Assumption {
    pub fn new(what: What, chosen: impl fmt::Display, why: Reason, certainty: Certainty) -> Self {
        Self { what, chosen: chosen.to_string(), why, certainty }
    }

    /// Whether it is unsure, or inferred and stated nowhere.
    pub fn is_guess(&self) -> bool {
        let interprets = !matches!(self.what, What::Missing | What::Size | What::Values);
        let is_stated = self.certainty >= Certainty::Sure || self.why.is_stated();
        self.certainty == Certainty::Unsure || (interprets && !is_stated)
    }

    /// Whether users are told about it without asking: it is unsure, or a map is missing, resized or changed. A choice that was
    /// specified is not doubtful.
    pub fn is_doubtful(&self) -> bool {
        match self.certainty {
            Certainty::Given => false,
            Certainty::Unsure => true,
            _ => matches!(self.what, What::Missing | What::Size | What::Values),
        }
    }

    /// A choice that the caller specified.
    pub fn given(what: What, chosen: impl fmt::Display) -> Self {
        Self::new(what, chosen, Reason::SPECIFIED, Certainty::Given)
    }
}

impl fmt::Display for Assumption {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let doubt = if self.certainty == Certainty::Unsure { " (unsure)" } else { "" };
        write!(f, "{}: {}{doubt}: {}", self.what.name(), self.chosen, self.why)
    }
}
