//! View of the window: light, camera and display, and how far the material can be panned.

pub mod endpoint;
pub mod framing;
pub mod geometry;
pub mod state;
