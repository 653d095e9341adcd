//! Support shared by the tests.

pub mod compare;
#[cfg(feature = "viewer")]
pub mod desktop;
pub mod exr;
pub mod fixtures;
#[cfg(feature = "viewer")]
pub mod gpu;
pub mod losses;
pub mod pictures;
pub mod png;
pub mod points;
pub mod surfaces;
pub mod surroundings;
pub mod textures;
pub mod tolerance;
