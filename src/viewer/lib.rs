//! The window: ground truth and predictions side by side under a light and a view that are dragged.
//!
//! In every frame input becomes commands, commands change the [`model`], and the model is drawn by `ui`. Slow work is done by
//! `jobs`; what a command does outside of the model is carried out by `app`.

#[cfg(feature = "viewer")]
pub mod app;
#[cfg(feature = "viewer")]
pub mod jobs;
pub mod model;
#[cfg(feature = "viewer")]
pub mod ui;
#[cfg(feature = "viewer")]
pub mod window;

pub use model::settings::options::ViewerOptions;
#[cfg(feature = "viewer")]
pub use window::run;
