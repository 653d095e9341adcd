//! The two precisions that everything is computed in, and their vectors.

pub mod real;
pub mod srgb;
