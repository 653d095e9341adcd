//! Materials with some maps of one material and the other maps of another.

use std::sync::Arc;

use super::{Material, Planes};
use crate::error::Error;
use crate::math::real::Real;

crate::choices! {
    /// One of the four maps of a material, in the order in which reports list them.
    #[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
    Map, "map":
    Normal = "normal",
    Diffuse = "diffuse",
    Specular = "specular",
    Roughness = "roughness",
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
