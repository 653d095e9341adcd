//! Jobs on what the panes display: the mixture, and numbers about values, differences, error maps and the rectangle.

pub mod difference;
pub mod error_map;
pub mod histograms;
pub mod mixture;
pub mod region;

use difference::DifferenceJob;
use error_map::ErrorMapJob;
use histograms::HistogramsJob;
use mixture::MixtureJob;
use region::RegionJob;

use crate::viewer::model::material::loaded::LoadedMaterial;

/// The jobs, and the materials in the panes.
#[derive(Debug, Default)]
pub struct PaneJobs {
    /// The materials, with a mixture in the place of the chosen prediction where one is displayed.
    pub displayed: Vec<LoadedMaterial>,
    pub mixture: MixtureJob,
    pub histograms: HistogramsJob,
    pub region: RegionJob,
    pub difference: DifferenceJob,
    pub error_map: ErrorMapJob,
}
