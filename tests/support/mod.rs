//! What the tests share.

pub mod compare;
pub mod fixtures;
#[cfg(feature = "gpu")]
pub mod gpu;
pub mod pictures;
pub mod points;
pub mod tolerance;
