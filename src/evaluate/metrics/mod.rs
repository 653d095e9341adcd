//! Differences of maps and of renderings beside the loss, each with its convention in its name: `docs/metrics.md` defines them.

mod maps;
mod pictures;
mod renderings;
mod selection;
mod ssim;

pub use maps::{Kept, of_maps, of_masked_maps};
pub use pictures::{PictureMetrics, of_pictures};
pub use renderings::{RenderedScenes, of_renderings};
pub use selection::MetricSelection;

/// A number and what it is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Metric {
    /// What is measured, of what, in which encoding.
    pub name: &'static str,
    pub value: f64,
    /// The 95% interval of the mean over all scenes, for metrics of sampled scenes; `None` where it is unknown.
    pub interval95: Option<[f64; 2]>,
}

impl Metric {
    /// A metric without an interval.
    fn exact(name: &'static str, value: f64) -> Self {
        Self { name, value, interval95: None }
    }
}

/// The peak signal-to-noise ratio of a root mean square error, for a peak of 1, in decibels; infinite for 0.
fn psnr(rmse: f64) -> f64 {
    -20.0 * rmse.log10()
}
