//! View of the window: light, camera and display, how they move, and how far the material can be panned.

pub mod animation;
pub mod endpoint;
pub mod geometry;
pub mod pan_limits;
pub mod state;
