//! Pictures of materials: what they show, from where, in which colours, and how they become files.

#[cfg(all(feature = "gpu", not(feature = "testing")))]
#[cfg_attr(not(feature = "viewer"), allow(dead_code, reason = "of the window"))]
pub(crate) mod camera;
#[cfg(feature = "testing")]
pub mod camera;
#[cfg(not(feature = "testing"))]
pub(crate) mod colour_map;
#[cfg(feature = "testing")]
pub mod colour_map;
pub mod difference;
pub mod differences;
pub mod export;
pub mod quantity;
pub mod shown;
pub mod statistics;
pub mod strip;
mod text;
#[cfg(not(feature = "testing"))]
pub(crate) mod tone;
#[cfg(feature = "testing")]
pub mod tone;
