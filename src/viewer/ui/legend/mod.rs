//! Legend of the differences, and histograms of the values.

pub mod histograms;
pub mod statistics;
pub mod strip;
