//! View of the window: light, camera and display, how they move, and how far the material can be panned.

pub mod animation;
pub mod endpoint;
pub mod framing;
pub mod geometry;
pub mod state;
pub mod texel_plane;
