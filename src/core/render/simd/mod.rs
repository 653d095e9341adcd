//! Algorithm 3 in f32 with SIMD instructions, one tile of texels at a time.
//!
//! One source is compiled for every instruction set, and the widest one is chosen at run time. For each tile, the
//! geometry that all materials share (`geometry`) is followed by the radiance of each material (`shade`). Whole
//! images (`image`) are these two passes; the loss adds a third, which compares radiances.

pub(crate) mod geometry;
mod image;
pub(crate) mod lanes;
pub(crate) mod shade;
pub(crate) mod size;
pub(crate) mod tile;

pub use image::render_at;
pub use lanes::Level;
