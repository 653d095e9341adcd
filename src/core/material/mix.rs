//! Materials with some maps of one material and the other maps of another.

use std::sync::Arc;

use serde::{Deserialize, Serialize};

use super::{Material, Planes};
use crate::error::Error;
use crate::math::real::Real;

/// One of the four maps of a material.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "lowercase")]
pub enum Map {
    Normal,
    Diffuse,
    Specular,
    Roughness,
}

impl Map {
    /// All four, in the order in which reports list them.
    pub const ALL: [Self; 4] = [Self::Normal, Self::Diffuse, Self::Specular, Self::Roughness];

    /// The name for users.
    pub fn name(self) -> &'static str {
        match self {
            Self::Normal => "normal",
            Self::Diffuse => "diffuse",
            Self::Specular => "specular",
            Self::Roughness => "roughness",
        }
    }
}

impl<T: Real> Material<T> {
    /// The same material with the maps that are `taken` replaced by those of `other`.
    ///
    /// # Errors
    /// [`Error::SizesDiffer`].
    pub fn with_maps_of(&self, other: &Self, taken: impl Fn(Map) -> bool) -> Result<Self, Error> {
        if self.size() != other.size() {
            return Err(Error::SizesDiffer {
                first: self.name().to_owned(),
                first_size: self.size(),
                second: other.name().to_owned(),
                second_size: other.size(),
                remedy: "resize them to one size",
            });
        }
        let of = |map| if taken(map) { &other.planes } else { &self.planes };
        let planes = Planes {
            normal: of(Map::Normal).normal.clone(),
            diffuse: of(Map::Diffuse).diffuse.clone(),
            specular: of(Map::Specular).specular.clone(),
            roughness: of(Map::Roughness).roughness.clone(),
        };
        Ok(Self { name: self.name.clone(), width: self.width, height: self.height, planes: Arc::new(planes) })
    }
}
