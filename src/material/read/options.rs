//! How stored values are to be understood, where a file cannot say it.

use std::fmt;
use std::str::FromStr;

use serde::{Deserialize, Serialize};

use crate::error::Error;

/// Colour space of diffuse and specular as stored. Normals and roughness are always linear.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum Albedo {
    /// The stored value is the reflectance.
    #[default]
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
    /// Every choice, the default first.
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
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum NormalY {
    /// Green grows towards the top ("OpenGL").
    #[default]
    #[serde(rename = "up")]
    Up,
    /// Green grows towards the bottom ("DirectX"); y is negated on reading.
    #[serde(rename = "down")]
    Down,
}

impl NormalY {
    /// Every choice, the default first.
    pub const ALL: [Self; 2] = [Self::Up, Self::Down];

    /// How users call it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Up => "up",
            Self::Down => "down",
        }
    }
}

/// What the user says about the files of a material.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(default)]
pub struct ReadOptions {
    pub albedo: Albedo,
    pub normal_y: NormalY,
}

impl fmt::Display for Albedo {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

impl fmt::Display for NormalY {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

impl FromStr for Albedo {
    type Err = Error;

    fn from_str(name: &str) -> Result<Self, Error> {
        Self::ALL.into_iter().find(|albedo| albedo.name() == name).ok_or_else(|| Error::UnknownName {
            what: "albedo",
            found: name.to_owned(),
            known: Self::ALL.map(Self::name).join(", "),
        })
    }
}

impl FromStr for NormalY {
    type Err = Error;

    fn from_str(name: &str) -> Result<Self, Error> {
        Self::ALL.into_iter().find(|normal_y| normal_y.name() == name).ok_or_else(|| Error::UnknownName {
            what: "direction of normal y",
            found: name.to_owned(),
            known: Self::ALL.map(Self::name).join(", "),
        })
    }
}
