//! Stored maps: what recognition hands to interpretation.

mod map;
mod material;

pub(super) use map::{StoredHeight, StoredMap};
pub(super) use material::{Inferences, Inferred, StoredMaterial};
