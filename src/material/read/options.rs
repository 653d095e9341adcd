//! How stored values are to be understood. Whatever a user leaves open is detected, and said.

use std::fmt;
use std::str::FromStr;

use serde::{Deserialize, Serialize};

use crate::error::Error;

/// The names of the values of an enum: for users, for files, and back.
macro_rules! named {
    ($type:ident, $what:literal) => {
        impl fmt::Display for $type {
            fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.pad(self.name())
            }
        }

        impl FromStr for $type {
            type Err = Error;

            fn from_str(name: &str) -> Result<Self, Error> {
                Self::ALL.into_iter().find(|value| value.name() == name).ok_or_else(|| Error::UnknownName {
                    what: $what,
                    found: name.to_owned(),
                    known: Self::ALL.map(Self::name).join(", "),
                })
            }
        }
    };
}

/// Colour space of diffuse, specular and base colour as stored.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum Albedo {
    /// The stored value is the reflectance.
    #[serde(rename = "linear")]
    Linear,
    /// Encoded by the transfer function of IEC 61966-2-1.
    #[serde(rename = "srgb")]
    Srgb,
    /// Encoded by the power 1 / 2.2.
    #[serde(rename = "gamma2.2")]
    Gamma22,
}

impl Albedo {
    /// Every choice.
    pub const ALL: [Self; 3] = [Self::Linear, Self::Srgb, Self::Gamma22];

    /// How users call it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Linear => "linear",
            Self::Srgb => "srgb",
            Self::Gamma22 => "gamma2.2",
        }
    }
}

/// Where the y axis of a normal map points, seen on the picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum NormalY {
    /// Green grows towards the top ("OpenGL").
    #[serde(rename = "up")]
    Up,
    /// Green grows towards the bottom ("DirectX"); y is negated on reading.
    #[serde(rename = "down")]
    Down,
}

impl NormalY {
    /// Every choice.
    pub const ALL: [Self; 2] = [Self::Up, Self::Down];

    /// How users call it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Up => "up",
            Self::Down => "down",
        }
    }
}

/// What the stored value c of a roughness map means; r is the roughness, alpha = r^2 the width of GGX.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum Roughness {
    /// r = c.
    #[serde(rename = "r")]
    R,
    /// Glossiness or smoothness: r = 1 - c.
    #[serde(rename = "gloss")]
    Gloss,
    /// The width of GGX itself: r = sqrt(c).
    #[serde(rename = "alpha")]
    Alpha,
    /// Stored like a colour: r = c^2.2.
    #[serde(rename = "gamma2.2")]
    Gamma22,
}

impl Roughness {
    /// Every choice.
    pub const ALL: [Self; 4] = [Self::R, Self::Gloss, Self::Alpha, Self::Gamma22];

    /// How users call it.
    pub fn name(self) -> &'static str {
        match self {
            Self::R => "r",
            Self::Gloss => "gloss",
            Self::Alpha => "alpha",
            Self::Gamma22 => "gamma2.2",
        }
    }
}

/// The order of the tiles of a packed image, row by row: N normal, D diffuse, R roughness, S specular.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Order {
    /// Deschaintre and most who follow.
    Ndrs,
    /// MaterialGAN.
    Dnrs,
    /// MaterialGAN without specular.
    Dnr,
    /// MatFusion.
    Dsrn,
    /// The 2 x 2 picture of svbrdf-diff-renderer.
    Ndsr,
}

impl Order {
    /// Every choice.
    pub const ALL: [Self; 5] = [Self::Ndrs, Self::Dnrs, Self::Dnr, Self::Dsrn, Self::Ndsr];

    /// How users call it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Ndrs => "ndrs",
            Self::Dnrs => "dnrs",
            Self::Dnr => "dnr",
            Self::Dsrn => "dsrn",
            Self::Ndsr => "ndsr",
        }
    }
}

/// What becomes of NaN and infinity.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum NonFinite {
    /// The first one is an error that says where it is and how many there are.
    #[default]
    Refuse,
    /// Colours become 0, roughness 1, normals (0, 0, 1); how many is said.
    Replace,
}

impl NonFinite {
    /// Every choice.
    pub const ALL: [Self; 2] = [Self::Refuse, Self::Replace];

    /// How users call it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Refuse => "refuse",
            Self::Replace => "replace",
        }
    }
}

named!(Albedo, "albedo");
named!(NormalY, "direction of normal y");
named!(Roughness, "meaning of roughness");
named!(Order, "order of tiles");
named!(NonFinite, "treatment of NaN and infinity");

/// What the user says about the files of a material. `None` is found out from the files, and said.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(default)]
pub struct ReadOptions {
    /// Colour space of diffuse, base colour and, unless `specular` says otherwise, specular.
    pub albedo: Option<Albedo>,
    /// Colour space of specular where it is another one.
    pub specular: Option<Albedo>,
    pub normal_y: Option<NormalY>,
    pub roughness: Option<Roughness>,
    /// Order of the tiles of a packed image.
    pub order: Option<Order>,
    /// Which of several materials, or rows of a packed image, from 0.
    pub exemplar: usize,
    pub non_finite: NonFinite,
}
