//! Read request: which materials are to be read, and where they go once they have been read.

use std::sync::Arc;

use svbrdf_files::samples;

use crate::error::Error;
use crate::model::material::loaded::LoadedMaterial;
use crate::model::material::read::{MaterialId, ReadMaterial};
use svbrdf_files::source::MaterialSource;

/// Where materials go once they have been read.
#[derive(Clone, Debug, PartialEq)]
pub enum Target {
    /// The first replaces the ground truth, the others the predictions.
    Everything,
    /// All are added as predictions.
    Predictions,
    /// The one replaces the material of this id, in its place.
    Again(MaterialId),
}

/// A material of a set: one that is in the window and stays, or one to be read.
#[derive(Clone, Debug)]
pub enum Item {
    Loaded(LoadedMaterial),
    Read(Box<MaterialSource>),
}

/// Materials to be read one after the other, and where they go.
#[derive(Clone, Debug)]
pub struct ReadRequest {
    pub items: Vec<Item>,
    pub target: Target,
}

impl ReadRequest {
    pub fn new(sources: Vec<MaterialSource>, target: Target) -> Self {
        Self { items: sources.into_iter().map(Box::new).map(Item::Read).collect(), target }
    }

    /// The built-in materials, in the place of all others.
    pub fn built_in() -> Self {
        Self::new((0..samples::COUNT).map(MaterialSource::built_in).collect(), Target::Everything)
    }
}

/// A material that has been read, or why not.
#[derive(Debug)]
pub enum Arrival {
    Loaded(LoadedMaterial),
    Read(Arc<ReadMaterial>),
    Failed(Box<MaterialSource>, Error),
}

/// Which opening an arrival belongs to, and how many were before it.
#[derive(Clone, Debug, PartialEq)]
pub struct ArrivalPlace {
    /// The number of the opening.
    pub opening: u64,
    pub target: Target,
    /// The names of all its materials.
    pub names: Vec<String>,
    pub arrived: usize,
}
