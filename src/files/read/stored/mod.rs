//! Stored maps: what recognition hands to interpretation.

mod map;
mod material;

pub(super) use map::StoredMap;
pub(super) use material::{Inferences, Inferred, StoredMaterial};
