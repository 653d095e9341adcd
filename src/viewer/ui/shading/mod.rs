//! Shading of the panes on the adapter: what is shaded in a frame, and pictures of the window.

pub mod draft_policy;
pub mod gpu_view;
pub mod shaded;
pub mod snapshot;
pub mod visible;
