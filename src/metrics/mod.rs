//! Differences of maps and of renderings beside the loss, each with its convention in its name: `docs/metrics.md` defines them.

mod maps;
mod renderings;

pub use maps::of_maps;
pub use renderings::of_renderings;

/// A number and what it is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Metric {
    /// What is measured, of what, in which encoding.
    pub name: &'static str,
    pub value: f64,
}
