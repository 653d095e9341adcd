//! The content of the files of a material, and the assumptions in reading them.

use serde::Serialize;

use svbrdf_core::math::real::Real;
use svbrdf_files::read::{Assumption, MapContent, Note, Read};

/// The content of the files of a material, and the assumptions in reading them.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct InfoReport {
    pub name: String,
    /// Width and height in texels.
    pub size: [usize; 2],
    /// The maps as stored.
    pub maps: Vec<MapContent>,
    pub assumptions: Vec<Assumption>,
    /// What was noticed in reading, in words.
    #[cfg_attr(feature = "schema", schemars(with = "Vec<String>"))]
    pub notes: Vec<Note>,
}

impl<T: Real> From<Read<T>> for InfoReport {
    fn from(read: Read<T>) -> Self {
        let Read { material, maps, assumptions, notes, .. } = read;
        Self { name: material.name().to_owned(), size: material.size(), maps, assumptions, notes }
    }
}
