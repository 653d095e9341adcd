//! Legend of the differences.

pub mod statistics;
pub mod strip;
