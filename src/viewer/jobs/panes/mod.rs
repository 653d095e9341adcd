//! Jobs on what the panes display: the replacement of the chosen prediction, and numbers about values, differences and error maps.

pub mod computed_maps;
pub mod difference;
pub mod error_map;
pub mod replacement;

use difference::DifferenceJob;
use error_map::ErrorMapJob;
use replacement::ReplacementJob;

use svbrdf_core::picture::quantity::Quantity;

use crate::model::Model;
use crate::model::material::loaded::LoadedMaterial;
use crate::model::material::read::MaterialId;

/// The jobs, and the materials in the panes.
#[derive(Debug, Default)]
pub struct PaneJobs {
    /// The materials, with a replacement of the chosen prediction where one is displayed.
    pub displayed: Vec<LoadedMaterial>,
    pub replacement: ReplacementJob,
    pub difference: DifferenceJob,
    pub error_map: ErrorMapJob,
    /// The automatic range of the predictions themselves: that of a replacement would change with it.
    pub auto_range: Option<(RangeKey, f64)>,
}

/// What an automatic range holds for: the materials and the difference, under any scene.
#[derive(Clone, Debug, PartialEq)]
pub struct RangeKey {
    ids: Vec<MaterialId>,
    quantity: Quantity,
    difference: &'static str,
}

impl RangeKey {
    pub fn of(model: &Model) -> Self {
        Self {
            ids: model.materials.all.iter().map(LoadedMaterial::id).collect(),
            quantity: model.view.display.quantity,
            difference: model.view.difference_name(),
        }
    }
}
