//! Errors planted in generated materials.

mod follow;
mod ladders;
pub(crate) mod materials;
mod planted;
mod shifts;
mod statistics;
