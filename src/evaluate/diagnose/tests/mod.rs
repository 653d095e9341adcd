//! Errors planted in generated materials.

#![allow(clippy::disallowed_methods, reason = "a test reads its own files")]

mod causes;
mod combined;
mod floors;
pub(crate) mod materials;
mod planted;
mod statistics;
