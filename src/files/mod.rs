//! Files: reading and writing materials, and writing any file as a whole or not at all.

#[cfg(not(feature = "testing"))]
pub(crate) mod atomic;
#[cfg(feature = "testing")]
pub mod atomic;
pub mod read;
pub mod write;
