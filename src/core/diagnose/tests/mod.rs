//! Errors planted in generated materials.

mod ladders;
mod materials;
mod planted;
mod statistics;
