//! What the panes display, asked for in every frame: the replacement of the chosen prediction, and numbers about differences, error maps
//! and the photograph.

pub mod computed_maps;
pub mod difference;
pub mod error_map;
pub mod photograph;
pub mod replacement;

use std::sync::Arc;

use svbrdf_core::picture::quantity::Quantity;

use crate::jobs::answers::Answered;
use crate::jobs::answers::content::Content;
use crate::model::Model;
use crate::model::material::loaded::LoadedMaterial;
use difference::ComputedDifference;
use photograph::{ComparePhotograph, Photographs, Samples};

/// What the panes display in this frame.
#[derive(Debug, Default)]
pub struct Panes {
    /// The materials, with a replacement of the chosen prediction where one is displayed.
    pub displayed: Vec<LoadedMaterial>,
    /// The difference of the materials, or their error map, and whether it is of the present scene and exposure.
    pub difference: Option<(Arc<Answered<ComputedDifference>>, bool)>,
    /// The share of the texels of error maps that is done, while they are rendered.
    pub error_map_progress: Option<f32>,
    pub photograph: Option<Samples>,
    pub photograph_failed: bool,
    /// Beside every material, and the question that it answers, perhaps of an earlier scene.
    pub photographs: Option<(ComparePhotograph, Arc<Answered<Photographs>>)>,
    /// The automatic range of the predictions themselves: that of a replacement would change with it.
    pub auto_range: Option<(RangeKey, f64)>,
}

/// What an automatic range holds for: the materials and the difference, under any scene.
#[derive(Clone, Debug, PartialEq)]
pub struct RangeKey {
    materials: Vec<Content>,
    quantity: Quantity,
    difference: &'static str,
}

impl RangeKey {
    pub fn of(model: &Model) -> Self {
        Self {
            materials: Content::all(&model.materials.all),
            quantity: model.view.display.quantity,
            difference: model.view.difference_name(),
        }
    }
}
