//! Differences of maps and of renderings beside the loss, each with its convention in its name: `docs/metrics.md` defines them.

mod dome_points;
mod maps;
mod matfusion;
mod pictures;
mod renderings;
mod ssim;

pub use maps::of_maps;
pub use matfusion::{matfusion_renderings, of_matfusion};
pub use pictures::{PictureMetrics, of_pictures};
pub use renderings::of_renderings;

/// A number and what it is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Metric {
    /// What is measured, of what, in which encoding.
    pub name: &'static str,
    pub value: f64,
}
