//! Support shared by the tests.

#[cfg(feature = "viewer")]
pub mod desktop;
#[cfg(feature = "viewer")]
pub mod gpu;
pub mod losses;
pub mod npy;
pub mod png;
pub mod points;
pub mod surroundings;
#[cfg(target_os = "linux")]
pub mod temporary;
pub mod textures;
pub mod tolerance;
