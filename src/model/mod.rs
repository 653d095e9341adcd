//! The model: what a texel reflects, under which scenes, by which convention. Pure functions of numbers.

pub mod brdf;
pub mod convention;
pub mod sampler;
pub mod scene;
