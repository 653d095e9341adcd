//! Errors planted in generated materials.

#![allow(clippy::disallowed_methods, reason = "a test reads its own files")]

mod follow;
mod ladders;
pub(crate) mod materials;
mod planted;
mod shifts;
mod statistics;
