//! The window: ground truth and predictions side by side under a light and a view that are dragged.
//!
//! In every frame input edits the [`model`], and the model is drawn; what is edited in a panel is drawn in the next frame. Slow work is
//! done by [`jobs`]. Each feature has a folder with its panel, over [`pane`] and below [`frame`].

pub mod dataset;
mod error;
pub mod files;
pub mod frame;
pub mod jobs;
pub mod loss;
pub mod message;
pub mod model;
pub mod pane;
pub mod photograph;
pub mod why;
pub mod widgets;
pub mod window;

pub use error::Error;
pub use model::dataset::OpenDataset;
pub use model::session::ViewerOptions;
pub use window::run;
