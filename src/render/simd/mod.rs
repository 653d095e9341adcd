//! Algorithm 3 in f32 at the speed of the machine: a few texels at a time, while these are in cache.
//!
//! One source, compiled for every instruction set and chosen at run time. For a tile of texels, the geometry that
//! all materials share (`geometry`) is followed by the radiance of each material (`shade`). Whole images (`picture`)
//! come from these two passes; the loss compares what they give.

pub(crate) mod geometry;
pub(crate) mod lanes;
mod picture;
pub(crate) mod shade;
pub(crate) mod tile;

pub use lanes::Level;
pub use picture::render_at;

/// Texels that one thread works on at a time, and whose logarithm the loss takes at once.
pub(crate) const TEXELS_PER_BLOCK: usize = 16 * tile::TEXELS;
