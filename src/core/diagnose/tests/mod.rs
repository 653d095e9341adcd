//! Errors planted in generated materials.

mod ladders;
pub(crate) mod materials;
mod planted;
mod statistics;
