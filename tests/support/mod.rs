//! What the tests share.

pub mod fixtures;
pub mod compare;
#[cfg(feature = "gpu")]
pub mod gpu;
pub mod points;
pub mod tolerance;
