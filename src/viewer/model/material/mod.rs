//! Materials of the window: where they come from, what was learnt in reading them, and the list of those that are loaded.

pub mod list;
pub mod loaded;
pub mod opening;
pub mod photograph;
pub mod read;
pub mod textures;
