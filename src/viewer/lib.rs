//! The window: ground truth and predictions side by side under a light and a view that are dragged.
//!
//! In every frame input becomes commands, commands change the [`model`], and the model is drawn by `ui`. Slow work is done by
//! `jobs`; what a command does outside of the model is carried out by `app`.

pub mod app;
mod error;
pub mod jobs;
pub mod model;
pub mod ui;
pub mod window;

pub use error::Error;
pub use model::dataset::OpenDataset;
pub use model::settings::options::ViewerOptions;
pub use window::run;
