//! Stored maps: what recognition hands to interpretation.

pub(super) mod map;
pub(super) mod material;
