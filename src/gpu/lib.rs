//! Algorithm 3 on the graphics adapter, offscreen and in a window. Knows the core and wgpu, and no egui.
//!
//! Two passes. `Shading` runs one fragment per texel of the map and writes linear floats: Algorithm 3 under a
//! scene, or one of the maps. `DisplayPass` runs one fragment per pixel of the screen: from the camera's ray to the
//! texels that are seen, averaged where they are smaller than a pixel, exposed and encoded. So shading is never
//! computed on filtered maps, and moving the camera costs no shading.
//!
//! Its shaders are those of [`svbrdf_shaders`]. Bad input and bad hardware never
//! panic: they are an [`Error::Gpu`](svbrdf_core::error::Error::Gpu) or wait in [`Gpu::take_fault`].

mod adapter;
pub mod choice;
mod codes;
mod context;
mod display;
mod fault;
mod packing;
mod params;
mod pipeline;
mod read_back;
mod shading;
mod still;
mod textures;
pub mod uniforms;

pub use adapter::AdapterReport;
pub use context::Gpu;
pub use display::{DisplayPass, Pane, PanePlace, texels_a_pixel};
pub use params::{DisplayMode, DisplayParams, DisplayedDifference, Encoding, ShadeParams};
pub use read_back::read_rgba;
pub use shading::{Shaded, Shading};
pub use still::{Blit, Still};
pub use textures::MaterialTextures;
