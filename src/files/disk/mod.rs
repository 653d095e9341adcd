//! The one door for files: what may be opened and how much of it, and how files are written, completely or not at all.

pub mod atomic;
pub mod inputs;
pub(crate) mod lfs;
pub mod memory;
pub(crate) mod new_folder;
pub mod open;
pub mod own;
pub(crate) mod panics;
pub mod paths;
pub mod signals;
pub mod stamp;
