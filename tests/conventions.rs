//! Conventions against the numbers of their authors' code.

mod losses;
pub mod peers;
mod sampling;
