//! Files: reading and writing materials, and writing any file as a whole or not at all.

pub mod atomic;
pub mod read;
pub mod write;
