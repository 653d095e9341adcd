//! Algorithm 1: the rendering loss of predictions against a ground truth.
//!
//! A [`Comparison`] holds what is compared, a [`Request`] says over which scenes, an [`Outcome`] has the losses with
//! their errors. The command line, the window, the study and the tests all ask this way.

mod adaptive;
mod batches;
mod comparison;
mod fused;
mod options;
mod outcome;
mod pilot;
mod pilot_mean;
mod plain;
mod request;
mod run;
mod settings;
mod statistics;
mod texels;

pub use adaptive::{MOST_SCENES, TEXELS};
pub use comparison::{Backend, Comparison, Compute, check_same_size};
pub use fused::Fused;
pub use options::LossOptions;
pub use outcome::{IntervalSource, Loss, Outcome};
pub use plain::Plain;
pub use request::{ALL_SCENES_TARGET, Precision, Request, Sampling, Texels};
pub use settings::{Ask, FileScenes, LossSettings};
pub use statistics::Estimate;
pub use texels::{SharedTexels, scene_losses as losses_on_texels};
