//! Algorithm 3 in f32 with SIMD instructions, one tile of texels at a time.
//!
//! One source is compiled for every instruction set, and the widest one is chosen at run time. For each tile, the
//! geometry that all materials share (`geometry`) is followed by the radiance of each material (`shade`). Whole
//! images (`image`) are these two passes; the loss adds a third, which compares radiances.

pub(crate) mod geometry;
mod image;
pub(crate) mod lanes;
pub(crate) mod shade;
pub(crate) mod tile;

pub use image::render_at;
pub use lanes::Level;

/// Texels of a tile. Its planes (22 KiB for two materials) stay in the L1 cache. A multiple of two vectors of every
/// instruction set.
pub(crate) const TEXELS: usize = 128;

/// Texels that one thread works on at a time, and whose logarithm the loss takes at once.
pub(crate) const TEXELS_PER_BLOCK: usize = 16 * TEXELS;

/// How far ahead of the current tile memory is prefetched, in texels. The next tile alone would arrive too late.
pub(crate) const AHEAD: usize = 2 * TEXELS;
