//! Opening: materials that are read one after the other, and where they go once they have been read.

use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

use svbrdf_core::material::Mask;
use svbrdf_files::samples;
use svbrdf_files::source::MaterialSource;

use crate::error::Error;
use crate::model::material::loaded::LoadedMaterial;
use crate::model::material::read::{MaterialId, ReadMaterial, Rules, label};

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

/// How materials are read one after the other.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Reading {
    pub rules: Rules,
    /// The size of the ground truth, once it is known.
    pub size: Option<[usize; 2]>,
    /// Its mask, where it has one.
    pub mask: Option<Mask>,
    /// Whether a file that cannot be read is tried again, where it was written a moment ago.
    pub retries: bool,
}

/// Materials that are read one after the other.
#[derive(Clone, Debug)]
pub struct Opening {
    /// No other one has it.
    pub number: u64,
    pub items: Arc<[Item]>,
    pub target: Target,
    pub reading: Reading,
    /// How many of them have arrived in the window.
    pub arrived: usize,
}

impl Opening {
    pub fn new(items: impl IntoIterator<Item = Item>, target: Target) -> Self {
        static OPENINGS: AtomicU64 = AtomicU64::new(0);
        let number = OPENINGS.fetch_add(1, Ordering::Relaxed);
        Self { number, items: items.into_iter().collect(), target, reading: Reading::default(), arrived: 0 }
    }

    pub fn of_sources(sources: impl IntoIterator<Item = MaterialSource>, target: Target) -> Self {
        Self::new(sources.into_iter().map(Box::new).map(Item::Read), target)
    }

    /// The built-in materials, in the place of all others.
    pub fn built_in() -> Self {
        Self::of_sources((0..samples::COUNT).map(MaterialSource::built_in), Target::Everything)
    }

    /// The name of the material in this place; empty where it has been read before.
    pub fn name(&self, place: usize) -> String {
        match self.items.get(place) {
            Some(Item::Read(source)) => label(source),
            Some(Item::Loaded(_)) | None => String::new(),
        }
    }

    /// What is being read, for a progress bar.
    pub fn text(&self) -> String {
        let name = self.name(self.arrived);
        match self.items.len() {
            1 => format!("Reading {name}"),
            count => format!("Reading {} of {count}: {name}", self.arrived + 1),
        }
    }

    /// Share of the materials that have been read, in [0, 1].
    pub fn fraction(&self) -> f32 {
        self.arrived as f32 / self.items.len().max(1) as f32
    }
}

/// A material that has been read, or why not.
#[derive(Clone, Debug)]
pub enum Arrival {
    Loaded(LoadedMaterial),
    Read(Arc<ReadMaterial>),
    Failed(Box<MaterialSource>, Arc<Error>),
}
