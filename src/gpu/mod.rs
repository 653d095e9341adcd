//! Algorithm 3 on the graphics adapter, offscreen and in a window. Knows the core and wgpu, and no egui.
//!
//! Two passes. `Shading` runs one fragment per texel of the map and writes linear floats: Algorithm 3 under a
//! scene, or one of the maps. `Display` runs one fragment per pixel of the screen: from the camera's ray to the
//! texels that are seen, averaged where they are smaller than a pixel, exposed and encoded. So shading is never
//! computed on filtered maps, and moving the camera costs no shading.
//!
//! [`GpuLosses`] is Algorithm 1 in compute shaders, for large jobs on a fast adapter.
//!
//! `shaders/` holds one idea a file; `shaders` says which files make a shader. Bad input and bad hardware never
//! panic: they are an [`Error::Gpu`](crate::error::Error::Gpu) or wait in [`Gpu::take_fault`].
#![cfg_attr(not(any(feature = "viewer", feature = "testing")), allow(dead_code, reason = "of the window"))]

mod adapter;
mod context;
mod display;
mod fault;
mod loss;
mod params;
mod pipeline;
#[cfg(feature = "testing")]
mod probe;
mod read_back;
mod render;
#[cfg(not(feature = "testing"))]
pub(crate) mod shaders;
#[cfg(feature = "testing")]
pub mod shaders;
mod shading;
mod still;
mod textures;
#[cfg(not(feature = "testing"))]
pub(crate) mod uniforms;
#[cfg(feature = "testing")]
pub mod uniforms;

pub use adapter::AdapterReport;
pub use context::Gpu;
pub use loss::GpuLosses;

#[cfg(feature = "viewer")]
pub(crate) use read_back::read_rgba;

#[cfg(not(feature = "testing"))]
#[allow(unused_imports, reason = "the window uses them all")]
pub(crate) use {
    display::{Display, Pane, PanePlace},
    params::{DisplayMode, DisplayParams, DisplayedDifference, Encoding, ShadeParams},
    shading::{Shaded, Shading},
    still::{Blit, Still},
    textures::MaterialTextures,
};
#[cfg(feature = "testing")]
pub use {
    display::{Display, Pane, PanePlace},
    params::{DisplayMode, DisplayParams, DisplayedDifference, Encoding, ShadeParams},
    shading::{Shaded, Shading},
    still::{Blit, Still},
    textures::MaterialTextures,
};
